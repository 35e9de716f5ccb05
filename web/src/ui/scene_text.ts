// The scene files of the runs, with comments set off.
import type { Viewer } from "../viewer";
import { h } from "./dom";

// A comment begins at a # that stands at the start of a line or behind a blank.
function paint(text: string): Node[] {
	return text.split(/(?<=\n)/).flatMap((line) => {
		const at = line.search(/(^|\s)#/);
		if (at < 0) return [document.createTextNode(line)];
		return [document.createTextNode(line.slice(0, at)), h("span", { className: "comment" }, line.slice(at))];
	});
}

export function makeSceneText(viewer: Viewer): HTMLElement {
	const seen = new Map<string, string[]>();
	for (const { run } of viewer.views) seen.set(run.facts.scene, [...(seen.get(run.facts.scene) ?? []), run.folder]);
	const parts = [...seen].map(([text, folders]) =>
		h("section", {}, h("h2", {}, folders.join(", ")), h("pre", { className: "scene-text" }, ...paint(text))),
	);
	return h("div", {}, ...parts);
}
