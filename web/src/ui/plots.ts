// Curves over time: energies, error, steps, Newton iterations, probes, and any other column. A line marks the time that is
// shown; a click goes to the time under it.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Pack } from "../data/pack";
import type { Viewer } from "../viewer";
import { plotColours, runDashes } from "./palette";
import { listCharts, type Chart, type Curve } from "./charts";
import { format, h } from "./dom";

const HEIGHT = 170;

// On logarithmic axes lines stand at powers of ten, and at every second or so when there are many.
function decades(_: uPlot, splits: number[]): (number | null)[] {
	const powers = splits.map((split) => Math.log10(split));
	const every = Math.ceil((powers.at(-1)! - powers[0]) / 6);
	const isShown = (power: number) => Math.abs(power - Math.round(power)) < 1e-6 && Math.round(power) % every === 0;
	return splits.map((split, i) => (isShown(powers[i]) ? split : null));
}

const show = (value: number | null) => (value === null ? "–" : format(value, 4));

const styleOf = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function axesOf(chart: Chart): uPlot.Axis[] {
	const lines = { stroke: styleOf("--line"), width: 1 };
	const axis: uPlot.Axis = { stroke: styleOf("--ink"), grid: lines, ticks: lines, font: "11px system-ui, sans-serif" };
	const log = { filter: decades, grid: { ...lines, filter: decades }, ticks: { ...lines, filter: decades } };
	const values: uPlot.Axis.DynamicValues = (_, ticks) => ticks.map((tick) => (tick === null ? "" : format(tick, 3)));
	return [
		{ ...axis, size: 26 },
		{ ...axis, ...(chart.isLog ? log : {}), size: 58, values },
	];
}

function lineOf(curve: Curve): uPlot.Series {
	return {
		label: curve.label,
		stroke: plotColours[curve.colour % plotColours.length],
		dash: runDashes[curve.dash % runDashes.length],
		width: 1.5,
		spanGaps: true,
		points: { show: false },
		value: (_, value) => show(value),
	};
}

export class Plots {
	readonly element = h("div", { className: "plots" });
	private list = h("div");
	private series: Pack[] = [];
	private plots: uPlot[] = [];
	private isLoading = false;
	private other = h("select", { "aria-label": "Column to plot" });

	constructor(private viewer: Viewer) {
		this.element.append(this.list, h("label", { className: "other" }, "Also plot ", this.other));
		this.other.addEventListener("change", () => this.redraw());
		new ResizeObserver(() => this.fit()).observe(this.element);
		this.load();
	}

	async load() {
		if (this.isLoading) return;
		this.isLoading = true;
		try {
			this.series = await Promise.all(this.viewer.views.map(({ run }) => run.series()));
			this.listColumns();
			this.redraw();
		} finally {
			this.isLoading = false;
		}
	}

	private listColumns() {
		const columns = this.series.flatMap(({ head }) => head.columns as { name: string }[]);
		const names = [...new Set(columns.map((column) => column.name))].filter((name) => name !== "t");
		const chosen = this.other.value;
		const options = names.map((name) => h("option", { value: name }, name));
		this.other.replaceChildren(h("option", { value: "" }, "…"), ...options);
		this.other.value = chosen;
	}

	redraw() {
		for (const plot of this.plots) plot.destroy();
		this.plots = [];
		this.list.replaceChildren();
		if (this.element.clientWidth === 0) return;
		const folders = this.viewer.views.map(({ run }) => run.folder);
		this.plots = listCharts(this.series, folders, this.other.value).map((chart) => this.draw(chart));
		this.updateTime();
	}

	private draw(chart: Chart): uPlot {
		const names = chart.curves.map((curve) => curve.label).join(", ");
		const box = h("figure", { role: "img", "aria-label": `${chart.title}: ${names}` });
		this.list.append(box);
		const options: uPlot.Options = {
			title: chart.title,
			width: this.element.clientWidth,
			height: HEIGHT,
			legend: { live: true },
			cursor: { sync: { key: "time" }, points: { size: 6 }, drag: { x: true, y: false, setScale: true } },
			scales: { x: { time: false }, y: chart.isLog ? { distr: 3 } : {} },
			axes: axesOf(chart),
			series: [{ label: "t [s]", value: (_, value) => show(value) }, ...chart.curves.map(lineOf)],
			hooks: { draw: [(drawn) => this.markTime(drawn)], ready: [(ready) => this.listen(ready)] },
		};
		return new uPlot(options, join(chart.curves), box);
	}

	// Like a drag, a click ends with the button going up; one that has moved chooses a range.
	private listen(plot: uPlot) {
		let start = 0;
		plot.over.addEventListener("mousedown", (event) => (start = event.clientX));
		plot.over.addEventListener("click", (event) => {
			if (Math.abs(event.clientX - start) > 3) return;
			this.viewer.playback.pause();
			this.viewer.playback.show(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x"));
		});
	}

	updateTime() {
		if (this.element.clientWidth === 0) return;
		for (const plot of this.plots) this.markTime(plot);
	}

	// A line of its own, so that the curves need not be drawn again.
	private markTime(plot: uPlot) {
		const mark = plot.over.querySelector<HTMLElement>(".mark") ?? h("div", { className: "mark" });
		if (!mark.parentElement) plot.over.append(mark);
		const x = plot.valToPos(this.viewer.playback.time, "x");
		mark.hidden = !(x >= 0 && x <= plot.over.clientWidth);
		mark.style.transform = `translateX(${x}px)`;
	}

	private fit() {
		const width = this.element.clientWidth;
		if (width > 0 && this.plots.length === 0) this.redraw();
		for (const plot of this.plots) if (plot.width !== width && width > 0) plot.setSize({ width, height: HEIGHT });
	}
}

// Curves of several runs have steps of their own: one table with gaps.
function join(curves: Curve[]): uPlot.AlignedData {
	const tables = curves.map(({ t, y }) => [Array.from(t), Array.from(y, (value) => (Number.isFinite(value) ? value : null))]);
	return uPlot.join(tables as uPlot.AlignedData[]);
}
