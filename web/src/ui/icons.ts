// Small drawings on buttons, 24 units square.
const paths: Record<string, string> = {
	play: "M8 5v14l11-7z",
	pause: "M7 5h4v14H7zM13 5h4v14h-4z",
	first: "M6 5h2.5v14H6zM20 5v14L9.5 12z",
	last: "M15.5 5H18v14h-2.5zM4 5v14l10.5-7z",
	back: "M17 5v14l-9-7zM5.5 5H8v14H5.5z",
	next: "M7 5v14l9-7zM16 5h2.5v14H16z",
	loop: "M7 7h9.6l-2-2L16 3.6 20.4 8 16 12.4 14.6 11l2-2H7a2.5 2.5 0 0 0-2.5 2.5V13h-2v-1.5A4.5 4.5 0 0 1 7 7zm10 10H7.400l2 2L8 20.4 3.6 16 8 11.6 9.4 13l-2 2H17a2.5 2.5 0 0 0 2.5-2.500V11h2v1.5A4.5 4.5 0 0 1 17 17z",
	fit: "M4 4h6v2H6v4H4zM14 4h6v6h-2V6h-4zM4 14h2v4h4v2H4zM18 14h2v6h-6v-2h4z",
	theme: "M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18v-2a7 7 0 0 0 0-14z",
	panel: "M3 4h18v16H3zm2 2v12h9V6zm11 0v12h3V6z",
	help: "M11 18h2v-2h-2zm1-16a10 10 0 1 0 0 20 10 10 0 0 0 0-20zm0 18a8 8 0 1 1 0-16 8 8 0 0 1 0 16zm0-14a4 4 0 0 0-4 4h2a2 2 0 1 1 4 0c0 2-3 1.75-3 5h2c0-2.25 3-2.5 3-5a4 4 0 0 0-4-4z",
	close: "M6.4 5 12 10.6 17.6 5 19 6.4 13.4 12 19 17.6 17.6 19 12 13.4 6.4 19 5 17.6 10.6 12 5 6.400z",
};

export function icon(name: string): SVGElement {
	const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
	svg.setAttribute("viewBox", "0 0 24 24");
	svg.setAttribute("aria-hidden", "true");
	const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
	path.setAttribute("d", paths[name]);
	svg.append(path);
	return svg;
}
