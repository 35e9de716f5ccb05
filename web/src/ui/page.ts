// The viewer as people see it: picture, controls, and a panel with plots, statistics and the scene.
import type { Viewer } from "../viewer";
import { looks } from "../scene/stage";
import { mapNames } from "../scene/colours";
import { listenToKeys } from "./commands";
import { button, makeControls } from "./controls";
import { h } from "./dom";
import { makeHelp } from "./help";
import { makeLabels } from "./labels";
import { makeLegend } from "./legend";
import { Panel } from "./panel";

export class Page {
	private help = makeHelp();
	private panel: Panel;
	private controls;
	private legend;
	private labels;
	private picture: HTMLElement;

	constructor(
		app: HTMLElement,
		readonly viewer: Viewer,
	) {
		const { stage, playback, colouring } = viewer;
		this.panel = new Panel(viewer);
		this.controls = makeControls(this);
		this.legend = makeLegend(colouring);
		this.labels = makeLabels(viewer);
		stage.canvas.tabIndex = 0;
		stage.canvas.setAttribute("role", "img");
		stage.canvas.setAttribute("aria-label", `Picture of ${viewer.views.map((view) => view.run.name).join(", ")}`);
		this.picture = h("main", { className: "picture" }, stage.canvas, this.labels.element, this.legend.element);
		app.append(this.makeHead(), this.picture, this.controls.element, this.panel.element, this.help);
		playback.onChange = () => this.updateTime();
		colouring.onChange = () => this.updateColours();
		new ResizeObserver(() => this.resize()).observe(this.picture);
		this.showTheme();
		this.updateColours();
		listenToKeys(this);
	}

	private makeHead() {
		const names = [...new Set(this.viewer.views.map((view) => view.run.name))].join(", ");
		document.title = `${names} – jounce`;
		return h(
			"header",
			{},
			h("h1", {}, names),
			this.labels.status,
			h("span", { className: "space" }),
			button("theme", "Dark or light", () => this.toggleTheme()),
			button("panel", "Plots and statistics", () => this.togglePanel()),
			button("help", "Keys", () => this.toggleHelp()),
		);
	}

	private resize() {
		const { stage } = this.viewer;
		stage.resize(this.picture.clientWidth, this.picture.clientHeight, Math.min(2, devicePixelRatio));
		this.labels.place();
	}

	private updateTime() {
		this.controls.updateTime();
		this.labels.update();
		this.panel.updateTime();
	}

	private updateColours() {
		this.controls.updateColours();
		this.legend.update();
	}

	// New frames or an outcome have come.
	updateRuns() {
		this.updateTime();
		this.panel.updateRuns();
	}

	async colourBy(field: string) {
		await this.viewer.colouring.choose(field);
		await this.viewer.playback.refresh();
	}

	setMap(name: string) {
		this.viewer.colouring.setMap(name);
		this.viewer.stage.request();
	}

	nextMap() {
		this.setMap(mapNames[(mapNames.indexOf(this.viewer.colouring.map) + 1) % mapNames.length]);
	}

	look(azimuth: number, elevation: number) {
		this.viewer.stage.fit({ azimuth, elevation });
	}

	toggleLoop() {
		this.viewer.playback.isLooping = !this.viewer.playback.isLooping;
		this.updateTime();
	}

	toggleTheme() {
		this.viewer.setTheme(this.viewer.theme === "dark" ? "light" : "dark");
		this.showTheme();
	}

	private showTheme() {
		document.documentElement.dataset.theme = this.viewer.theme;
		document.documentElement.style.setProperty("--picture", `#${looks[this.viewer.theme].background.getHexString()}`);
		this.panel.redraw();
	}

	togglePanel() {
		document.body.classList.toggle("without-panel");
	}

	toggleHelp() {
		if (this.help.open) this.help.close();
		else this.help.showModal();
	}
}
