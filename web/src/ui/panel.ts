// Plots, statistics and the text of the scene, behind tabs.
import type { Viewer } from "../viewer";
import { h } from "./dom";
import { Plots } from "./plots";
import { makeSceneText } from "./scene_text";
import { makeStatistics } from "./statistics";

type Tab = { name: string; tab: HTMLButtonElement; content: HTMLElement };

export class Panel {
	readonly element: HTMLElement;
	private plots: Plots;
	private statistics;
	private tabs: Tab[];

	constructor(viewer: Viewer) {
		this.plots = new Plots(viewer);
		this.statistics = makeStatistics(viewer);
		this.tabs = [
			this.makeTab("plots", "Plots", this.plots.element),
			this.makeTab("statistics", "Statistics", this.statistics.element),
			this.makeTab("scene", "Scene", makeSceneText(viewer)),
		];
		const buttons = this.tabs.map((tab) => tab.tab);
		const contents = this.tabs.map((tab) => tab.content);
		const list = h("div", { className: "tabs", role: "tablist", "aria-label": "About the runs" }, ...buttons);
		list.addEventListener("keydown", (event) => this.move(event as KeyboardEvent));
		this.element = h("aside", { className: "panel", "aria-label": "Plots and statistics" }, list, ...contents);
		this.choose(this.tabs[0]);
	}

	private makeTab(name: string, label: string, child: HTMLElement): Tab {
		const tab = h("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": `panel-${name}` }, label);
		const content = h(
			"div",
			{ role: "tabpanel", id: `panel-${name}`, "aria-labelledby": `tab-${name}`, tabIndex: 0, className: "content" },
			child,
		);
		const made = { name, tab, content };
		tab.addEventListener("click", () => this.choose(made));
		return made;
	}

	private choose(chosen: Tab) {
		for (const { tab, content } of this.tabs) {
			const isChosen = tab === chosen.tab;
			tab.setAttribute("aria-selected", String(isChosen));
			tab.tabIndex = isChosen ? 0 : -1;
			content.hidden = !isChosen;
		}
		if (chosen.name === "plots") this.plots.redraw();
	}

	private move(event: KeyboardEvent) {
		const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
		if (step === undefined) return;
		const at = this.tabs.findIndex(({ tab }) => tab === event.target);
		const next = this.tabs[(at + step + this.tabs.length) % this.tabs.length];
		this.choose(next);
		next.tab.focus();
	}

	updateTime() {
		this.plots.updateTime();
	}

	updateRuns() {
		this.plots.load();
		this.statistics.update();
	}

	redraw() {
		this.plots.redraw();
	}
}
