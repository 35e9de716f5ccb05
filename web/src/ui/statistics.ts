// Facts about the runs, side by side: what was simulated, how exact it is, what it cost.
import type { Run } from "../data/run";
import type { Viewer } from "../viewer";
import { format, h } from "./dom";

type Row = [label: string, value: (run: Run) => string | number | null | undefined, unit?: string];

const of = (name: string) => (run: Run) => run.summary[name];
const seconds = (name: string, label: string): Row => [label, of(name), "s"];

const groups: [title: string, rows: Row[]][] = [
	[
		"Run",
		[
			["Outcome", (run) => run.state.message || run.state.outcome],
			["Method", (run) => run.facts.method],
			["Simulated time", (run) => run.times.at(-1), "s"],
			["Frames", (run) => run.frameCount],
			["Bodies", (run) => run.bodies.length],
			["Nodes", (run) => run.facts.node_count],
			["Cells", (run) => run.bodies.reduce((sum, body) => sum + body.cells, 0)],
			["Mass", (run) => run.facts.total_mass, "kg"],
		],
	],
	[
		"Accuracy",
		[
			["Energy error at the end", of("specific_error"), "J/kg"],
			["Largest energy error", of("specific_error_max"), "J/kg"],
		],
	],
	[
		"Cost",
		[
			["Steps", of("steps")],
			["Rejected steps", of("rejected")],
			["Newton iterations", of("newton")],
			["Factorisations", of("factorizations")],
			["Solves", of("solves")],
			["Forces", of("forces")],
			["Tangents", of("tangents")],
			seconds("wall_seconds", "Stepping"),
			seconds("seconds_predict", "– free motion"),
			seconds("seconds_detect", "– detection"),
			seconds("seconds_factor", "– contact factors"),
			seconds("seconds_qp", "– contact solver"),
			seconds("setup_seconds", "Setting up"),
			["Wall time a simulated second", of("wall_seconds_per_simulated_second"), "s"],
			["Threads", of("threads")],
		],
	],
	[
		"Made by",
		[
			["jounce", (run) => run.facts.version],
			["Dense kernels", of("blas")],
			["Machine", (run) => run.facts.host],
			["Started", (run) => run.facts.created],
		],
	],
];

const show = (value: string | number | null | undefined, unit = "") =>
	value === null || value === undefined ? "–" : typeof value === "string" ? value
		: `${Number.isInteger(value) && Math.abs(value) < 1e9 ? value.toLocaleString("en") : format(value, 4)}${unit && ` ${unit}`}`;

export function makeStatistics(viewer: Viewer) {
	const runs = viewer.views.map((view) => view.run);
	const table = h("table", { className: "statistics" });
	const head = () => h("thead", {}, h("tr", {}, h("td", {}), ...runs.map((run) => h("th", { scope: "col" }, run.folder))));
	const body = ([title, rows]: (typeof groups)[number]) =>
		h(
			"tbody",
			{},
			h("tr", {}, h("th", { scope: "colgroup", className: "group", colSpan: runs.length + 1 }, title)),
			...rows
				.filter(([, value]) => runs.some((run) => value(run) !== undefined && value(run) !== null))
				.map(([label, value, unit]) =>
					h("tr", {}, h("th", { scope: "row" }, label), ...runs.map((run) => h("td", {}, show(value(run), unit)))),
				),
		);
	const update = () => table.replaceChildren(head(), ...groups.map(body));
	update();
	return { element: table, update };
}
