// Time, common to all runs. It never runs ahead of the frames: what is shown of all runs belongs to one time.
import type { RunView } from "./scene/run_view";
import type { Stage } from "./scene/stage";

// Simulated seconds a second.
export const speedList = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];
const SHORTEST = 2; // [s]: what is over sooner is played more slowly
const LONGEST = 60; // [s]

const AHEAD = 4; // frames that are asked for before they are needed

export class Playback {
	time = 0;
	isPlaying = false;
	isLooping = true;
	speed = 1; // simulated seconds a second
	onChange: () => void = () => {};
	private last = 0;
	private wanted = 0; // number of the latest wish; older ones are dropped

	constructor(private stage: Stage) {}

	private get views(): RunView[] {
		return this.stage.views;
	}

	get start() {
		return Math.min(...this.views.map((view) => view.run.times[0] ?? 0));
	}

	get end() {
		return Math.max(...this.views.map((view) => view.run.times.at(-1) ?? 0));
	}

	// Real time, unless all would be over in a blink, or hardly ever.
	chooseSpeed() {
		const duration = this.end - this.start;
		if (this.views.some((view) => view.run.state.is_running)) return;
		if (duration < SHORTEST) this.speed = speedList.findLast((speed) => duration >= SHORTEST * speed) ?? speedList[0];
		if (duration > LONGEST) this.speed = speedList.find((speed) => duration <= LONGEST * speed) ?? speedList.at(-1)!;
		if (duration <= LONGEST && duration >= SHORTEST) this.speed = 1;
	}

	// Show the frames of a time; done when they are drawn.
	async show(time: number): Promise<void> {
		const wish = ++this.wanted;
		this.time = Math.min(this.end, Math.max(this.start, Number.isNaN(time) ? this.start : time));
		this.onChange();
		const frames = this.views.map((view) => view.run.frameAt(this.time));
		const apply = await Promise.all(this.views.map((view, i) => view.load(frames[i])));
		if (wish !== this.wanted) return;
		for (const change of apply) change();
		this.stage.draw();
		this.onChange();
	}

	// Show again what may look different now.
	refresh() {
		return this.show(this.time);
	}

	// The next or the previous frame of any run.
	step(direction: 1 | -1) {
		this.pause();
		const slack = 1e-9 * Math.max(1, Math.abs(this.time));
		const times = this.views.map((view) => {
			const at = view.run.frameAt(this.time);
			const behind = direction < 0 && view.run.times[at] < this.time - slack ? at : at + direction;
			return view.run.times[Math.min(view.run.frameCount - 1, Math.max(0, behind))] ?? 0;
		});
		const later = times.filter((time) => (time - this.time) * direction > slack);
		return this.show(later.length === 0 ? this.time : direction > 0 ? Math.min(...later) : Math.max(...later));
	}

	play() {
		if (this.isPlaying) return;
		if (this.time >= this.end) this.time = this.start;
		this.isPlaying = true;
		this.stage.begin();
		this.last = performance.now();
		requestAnimationFrame(() => this.tick());
		this.onChange();
	}

	pause() {
		if (this.isPlaying) this.stage.end();
		this.isPlaying = false;
		this.onChange();
	}

	toggle() {
		if (this.isPlaying) this.pause();
		else this.play();
	}

	private async tick() {
		if (!this.isPlaying) return;
		const now = performance.now();
		const step = Math.min(0.25, (now - this.last) / 1000) * this.speed;
		this.last = now;
		let time = this.time + step;
		if (time > this.end) {
			const isLive = this.views.some((view) => view.run.state.is_running);
			if (this.isLooping && !isLive) time = this.start;
			else if (!isLive) this.pause();
		}
		this.stage.hurry();
		await this.show(time);
		this.prefetch();
		requestAnimationFrame(() => this.tick());
	}

	private prefetch() {
		for (const view of this.views) {
			const frame = view.run.frameAt(this.time);
			for (let i = 1; i <= AHEAD && frame + i < view.run.frameCount; ++i) view.load(frame + i).catch(() => {});
		}
	}
}
