// Bare pictures for programs: ?render shows nothing but the scene, the legend if a field is chosen, and the hook
// window.jounce.
import type { Viewer } from "./viewer";
import { makeLegend } from "./ui/legend";

export function showRender(app: HTMLElement, viewer: Viewer) {
	const { stage, colouring, options } = viewer;
	const [width, height] = options.size ?? [innerWidth, innerHeight];
	document.body.classList.add("render");
	document.documentElement.dataset.theme = viewer.theme;
	app.append(stage.canvas);
	stage.canvas.style.width = `${width}px`;
	stage.canvas.style.height = `${height}px`;
	stage.resize(width, height, devicePixelRatio);
	if (options.hasLegend) {
		const legend = makeLegend(colouring);
		colouring.onChange = legend.update;
		app.append(legend.element);
	}
}
