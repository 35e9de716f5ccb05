// What the colours mean.
import type { Colouring } from "../colouring";
import { mapGradient } from "../scene/colours";
import { format, h } from "./dom";

export function makeLegend(colouring: Colouring): { element: HTMLElement; update: () => void } {
	const title = h("div", { className: "legend-title" });
	const bar = h("div", { className: "legend-bar" });
	const ticks = h("div", { className: "legend-ticks" });
	const element = h("div", { className: "legend", role: "img" }, title, bar, ticks);
	const update = () => {
		const choice = colouring.choice;
		element.hidden = !choice;
		if (!choice) return;
		const [low, high] = colouring.range;
		title.textContent = choice.label + (choice.unit ? ` [${choice.unit}]` : "");
		bar.style.background = mapGradient(colouring.map);
		ticks.replaceChildren(...[0, 0.5, 1].map((share) => h("span", {}, format(low + share * (high - low)))));
		element.setAttribute("aria-label", `${title.textContent}: colours from ${format(low)} to ${format(high)}`);
	};
	update();
	return { element, update };
}
