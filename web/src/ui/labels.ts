// Names over the parts of the picture, and what became of the runs.
import type { RunView } from "../scene/run_view";
import type { Viewer } from "../viewer";
import { format, h } from "./dom";

function describe(view: RunView): string {
	const { state } = view.run;
	if (state.is_running) return "running";
	if (state.outcome === "running") return "unfinished";
	return state.outcome;
}

export function makeLabels(viewer: Viewer) {
	const { stage, views, playback } = viewer;
	const status = h("span", { className: "status", role: "status" });
	const tags = views.map((view) => h("div", { className: "tag" }, h("strong", {}, view.run.folder), h("span", {})));
	const failures = viewer.entries.filter((entry) => entry.error !== undefined);
	const messages = failures.map((entry) => h("p", { className: "message", role: "alert" }, entry.error!));
	const element = h("div", { className: "labels" }, ...tags, ...messages);
	const update = () => {
		const words = [...new Set(views.map(describe))].join(", ");
		if (status.textContent !== words) status.textContent = words;
		status.dataset.outcome = words;
		status.title = views.map((view) => view.run.state.message).filter(Boolean).join("\n");
		views.forEach((view, i) => {
			const time = view.run.times[view.frame];
			const isEnded = time !== undefined && playback.time > (view.run.times.at(-1) ?? 0) + 1e-9;
			tags[i].lastElementChild!.textContent = `${view.run.facts.method}, ${format(time ?? 0, 4)} s${isEnded ? ", ended" : ""}`;
		});
	};
	const place = () =>
		stage.parts().forEach((part, i) => Object.assign(tags[i].style, { left: `${part.left}px`, top: `${part.top}px` }));
	return { element, status, update, place };
}
