// Words over a bare picture: the legend, the time, and the names of several runs.
import { colourAt } from "./scene/colours";
import { looks } from "./scene/stage";
import { format } from "./ui/dom";
import type { Viewer } from "./viewer";

export type Words = { legend: boolean; time: boolean; names: boolean };
type Pen = CanvasRenderingContext2D;

const FONT = '"DejaVu Sans", system-ui, sans-serif';
const inks = { light: "#1b2430", dark: "#e7ecf3" };

// Height of the letters: a share of the picture, within what can be read.
const sizeOf = (pen: Pen) => Math.max(11, Math.round(Math.min(pen.canvas.height / 30, pen.canvas.width / 45)));

// A patch of the background's colour, on which words can be read over anything.
function patch(pen: Pen, viewer: Viewer, left: number, top: number, width: number, height: number) {
	pen.save();
	pen.globalAlpha = 0.8;
	pen.fillStyle = `#${looks[viewer.theme].background.getHexString()}`;
	pen.beginPath();
	pen.roundRect(left, top, width, height, height / 6);
	pen.fill();
	pen.restore();
}

function writeLegend(pen: Pen, viewer: Viewer, size: number) {
	const { colouring } = viewer;
	const { choice, map, range } = colouring;
	if (!choice) return;
	const width = 17 * size;
	const left = 1.6 * size;
	const top = pen.canvas.height - 5.2 * size;
	patch(pen, viewer, left - 0.8 * size, top - 0.8 * size, width + 1.6 * size, 5 * size);
	pen.textBaseline = "top";
	pen.textAlign = "left";
	pen.fillText(choice.label + (choice.unit ? ` [${choice.unit}]` : ""), left, top - 0.2 * size);
	const ramp = pen.createLinearGradient(left, 0, left + width, 0);
	for (let i = 0; i <= 32; ++i) ramp.addColorStop(i / 32, `rgb(${colourAt(map, i / 32).join(" ")})`);
	const ink = pen.fillStyle;
	pen.fillStyle = ramp;
	pen.fillRect(left, top + 1.3 * size, width, 0.9 * size);
	pen.fillStyle = ink;
	(["left", "center", "right"] as const).forEach((align, i) => {
		pen.textAlign = align;
		pen.fillText(format(range[0] + (i / 2) * (range[1] - range[0])), left + (i / 2) * width, top + 2.6 * size);
	});
}

// A unit for all of the times, and as many digits as tell them apart.
export function clockOf(times: number[]): (time: number) => string {
	const last = Math.max(...times.map(Math.abs));
	const [unit, scale] = last >= 1 || last === 0 ? ["s", 1] : last >= 1e-3 ? ["ms", 1e3] : ["µs", 1e6];
	const step = times.length > 1 ? (Math.max(...times) - Math.min(...times)) / (times.length - 1) : last / 100;
	const digits = step > 0 ? Math.min(4, Math.max(0, Math.ceil(-Math.log10(step * scale) - 1e-6))) : 2;
	return (time) => `${(time * scale).toFixed(digits)} ${unit}`;
}

// Times that are shown lie within the runs, whatever was asked for.
function writeTime(pen: Pen, viewer: Viewer, size: number, times: number[]) {
	const { views, playback } = viewer;
	const time = views.length === 1 ? (views[0].run.times[views[0].frame] ?? 0) : playback.time;
	const text = clockOf(times.map((wish) => Math.min(wish, playback.end)))(time);
	const width = pen.measureText(text).width;
	const right = pen.canvas.width - 1.4 * size;
	const bottom = pen.canvas.height - 1.2 * size;
	patch(pen, viewer, right - width - 0.6 * size, bottom - 1.4 * size, width + 1.2 * size, 1.9 * size);
	pen.textBaseline = "alphabetic";
	pen.textAlign = "right";
	pen.fillText(text, right, bottom);
}

// The last folder is what tells runs apart, as a rule.
const shortOf = (folder: string) => folder.replace(/\/+$/, "").split("/").at(-1) || folder;

function writeNames(pen: Pen, viewer: Viewer, size: number) {
	const ratio = pen.canvas.width / viewer.stage.canvas.width;
	const pixels = viewer.stage.renderer.getPixelRatio();
	pen.textBaseline = "top";
	pen.textAlign = "left";
	viewer.stage.parts().forEach((part, i) => {
		const { facts, folder } = viewer.views[i].run;
		const text = `${shortOf(folder)}, ${facts.method}`;
		const left = part.left * pixels * ratio + 1.2 * size;
		const top = part.top * pixels * ratio + 1.1 * size;
		patch(pen, viewer, left - 0.5 * size, top - 0.4 * size, pen.measureText(text).width + size, 1.9 * size);
		pen.fillText(text, left, top);
	});
}

export function write(pen: Pen, viewer: Viewer, words: Words, times: number[]) {
	const size = sizeOf(pen);
	pen.font = `${size}px ${FONT}`;
	pen.fillStyle = inks[viewer.theme];
	if (words.legend) writeLegend(pen, viewer, size);
	if (words.time) writeTime(pen, viewer, size, times);
	if (words.names && viewer.views.length > 1) writeNames(pen, viewer, size);
}
