// The parts of the page that both the viewer and bare pictures have.
import { Colouring } from "./colouring";
import { Run } from "./data/run";
import type { RunEntry, Source } from "./data/source";
import type { Options } from "./options";
import { Playback } from "./playback";
import { RunView } from "./scene/run_view";
import { Stage, looks } from "./scene/stage";

export class Viewer {
	readonly stage: Stage;
	readonly playback: Playback;
	readonly colouring: Colouring;
	theme: "light" | "dark";

	private constructor(
		readonly source: Source,
		readonly entries: RunEntry[],
		readonly options: Options,
		readonly views: RunView[],
		theme: "light" | "dark",
	) {
		this.theme = theme;
		this.stage = new Stage(document.createElement("canvas"), options.isRender);
		this.stage.views = views;
		this.playback = new Playback(this.stage);
		this.colouring = new Colouring(this.stage);
		this.colouring.list();
	}

	// Runs that cannot be opened are in `entries` with the reason.
	static async open(source: Source, options: Options): Promise<Viewer> {
		const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
		const theme = options.theme ?? (isDark && !options.isRender ? "dark" : "light");
		const entries = await source.runs();
		const numbers = entries.map((_, i) => i).filter((i) => entries[i].error === undefined);
		const runs = await Promise.all(numbers.map((i) => Run.open(source, i)));
		const views = await Promise.all(runs.map((run) => RunView.create(run, looks[theme])));
		return new Viewer(source, entries, options, views, theme);
	}

	// Colours, camera and time as the address asks for.
	async start() {
		const { options, colouring, stage, playback } = this;
		if (options.map) colouring.setMap(options.map);
		await colouring.choose(options.field, options.range);
		stage.fit(options.camera);
		playback.chooseSpeed();
		const first = this.views[0]?.run;
		const time = options.frame !== null ? first?.times[options.frame] : options.time;
		await playback.show(time ?? playback.start);
	}

	setTheme(theme: "light" | "dark") {
		this.theme = theme;
		for (const view of this.views) view.show(looks[theme]);
		this.stage.request();
	}
}
