// What the address of the page asks for, such as ?field=stress&camera=30,15,1.2&time=0.5; docs/viewer.md tells all.
import type { CameraChoice } from "./scene/stage";

export type Options = {
	isRender: boolean; // a bare picture for programs
	shootKey: string | null; // `jounce render` waits for pictures, and shows by this key that it is it
	size: [width: number, height: number] | null;
	camera: Partial<CameraChoice>;
	field: string;
	map: string | null;
	range: [low: number, high: number] | null;
	time: number | null;
	frame: number | null;
	theme: "light" | "dark" | null;
	hasLegend: boolean;
};

const numbersOf = (text: string | null, separator: RegExp): number[] =>
	(text ?? "").split(separator).map(Number).filter(Number.isFinite);

const numberOf = (text: string | null): number | null =>
	text !== null && text !== "" && Number.isFinite(Number(text)) ? Number(text) : null;

export function readOptions(search: string): Options {
	const ask = new URLSearchParams(search);
	const size = numbersOf(ask.get("size"), /x/);
	const range = numbersOf(ask.get("range"), /,/);
	const [azimuth, elevation, zoom] = ask.has("camera") ? numbersOf(ask.get("camera"), /,/) : [];
	const theme = ask.get("theme");
	return {
		isRender: ask.has("render"),
		shootKey: ask.get("shoot"),
		size: size.length === 2 ? [size[0], size[1]] : null,
		camera: { azimuth, elevation, zoom },
		field: ask.get("field") ?? "",
		map: ask.get("map"),
		range: range.length === 2 ? [range[0], range[1]] : null,
		time: numberOf(ask.get("time")),
		frame: numberOf(ask.get("frame")),
		theme: theme === "light" || theme === "dark" ? theme : null,
		hasLegend: ask.get("legend") !== "0",
	};
}
