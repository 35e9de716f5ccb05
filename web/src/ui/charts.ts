// Which curves are drawn together. One run shows its parts; of several runs each is one curve.
import type { Pack } from "../data/pack";

export type Curve = { label: string; t: ArrayLike<number>; y: ArrayLike<number>; colour: number; dash: number };
export type Chart = { title: string; isLog: boolean; curves: Curve[] };

type Plan = { title: string; columns: string[]; main: string; isLog?: boolean; isOfSteps?: boolean };

const plans: Plan[] = [
	{ title: "Energy", columns: ["kinetic", "elastic", "gravity", "total"], main: "total" },
	{ title: "Energy error", columns: ["specific_error"], main: "specific_error", isLog: true },
	{ title: "Step size", columns: ["dt"], main: "dt", isOfSteps: true },
	{ title: "Newton iterations", columns: ["newton"], main: "newton", isOfSteps: true },
];

function unitOf(series: Pack[], name: string): string {
	for (const { head } of series)
		for (const column of head.columns) if (column.name === name) return column.unit ? ` [${column.unit}]` : "";
	return "";
}

// The start is no step: it has no length and no iterations.
const withoutStart = (values: ArrayLike<number>) => Array.from(values, (value, i) => (i === 0 ? NaN : value));

// Logarithmic axes have no place for what is not above 0.
const positive = (values: ArrayLike<number>) => Array.from(values, (value) => (value > 0 ? value : NaN));

function chartOf(plan: Plan, series: Pack[], names: string[]): Chart {
	const curves: Curve[] = [];
	series.forEach(({ arrays }, run) => {
		const columns = series.length > 1 ? [plan.main] : plan.columns;
		columns.forEach((column, part) => {
			if (!arrays[column]) return;
			const isAlone = series.length === 1;
			const y = plan.isLog ? positive(arrays[column]) : plan.isOfSteps ? withoutStart(arrays[column]) : arrays[column];
			curves.push({ label: isAlone ? column : names[run], t: arrays.t, y, colour: isAlone ? part : run, dash: isAlone ? 0 : run });
		});
	});
	const hasPositive = curves.some(({ y }) => Array.prototype.some.call(y, (value: number) => value > 0));
	return { title: plan.title + unitOf(series, plan.main), isLog: Boolean(plan.isLog) && hasPositive, curves };
}

// A probe has three coordinates; of several runs the vertical one is compared.
function probePlans(series: Pack[]): Plan[] {
	const names = new Set<string>();
	for (const { arrays } of series)
		for (const column of Object.keys(arrays)) if (/^probe\..*\.x$/.test(column)) names.add(column.slice(6, -2));
	return [...names].map((name) => ({
		title: `Probe ${name}${series.length > 1 ? ", y" : ""}`,
		columns: ["x", "y", "z"].map((axis) => `probe.${name}.${axis}`),
		main: `probe.${name}.y`,
	}));
}

export function listCharts(series: Pack[], names: string[], other: string): Chart[] {
	const all = [...plans, ...probePlans(series)];
	if (other) all.push({ title: other, columns: [other], main: other });
	return all.map((plan) => chartOf(plan, series, names)).filter((chart) => chart.curves.some(({ y }) => y.length > 0));
}
