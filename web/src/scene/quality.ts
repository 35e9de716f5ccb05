// How much work a picture may be. What stands still is drawn as well as can be; what moves, as well as it can be drawn in time.

export type Level = {
	ratio: number; // pixels of the picture, along an edge, over those of the screen
	isSoft: boolean; // shadows with soft edges
	shadowSize: number; // of the shadow's picture, along an edge
	shadowEvery: number; // pictures that a shadow stands for
};

const best: Level = { ratio: 1, isSoft: true, shadowSize: 2048, shadowEvery: 1 };
const levels: Level[] = [
	best,
	{ ratio: 1, isSoft: false, shadowSize: 1024, shadowEvery: 1 },
	{ ratio: 0.7, isSoft: false, shadowSize: 1024, shadowEvery: 3 },
	{ ratio: 0.5, isSoft: false, shadowSize: 512, shadowEvery: 3 },
];

const SLOW = 36; // [ms] between pictures, hardly fewer than 30 a second: too much work
const FAST = 19; // [ms]: there is time for more
const PATIENCE = 60; // pictures that were fast, before more is tried

export class Quality {
	private level: number;
	private average = 30; // [ms]
	private fastCount = 0;

	constructor(isSoftware: boolean) {
		this.level = isSoftware ? 2 : 0;
	}

	get resting(): Level {
		return best;
	}

	get moving(): Level {
		return levels[this.level];
	}

	// The time since the last picture of a motion [ms].
	note(interval: number) {
		this.average += 0.2 * (Math.min(interval, 200) - this.average);
		this.fastCount = this.average < FAST ? this.fastCount + 1 : 0;
		if (this.average > SLOW && this.level + 1 < levels.length) this.change(1);
		if (this.fastCount > PATIENCE && this.level > 0) this.change(-1);
	}

	private change(direction: 1 | -1) {
		this.level += direction;
		this.fastCount = 0;
		this.average = 30;
	}
}

// Is there a graphics processor behind a context of WebGL?
export function isSoftware(): boolean {
	const context = document.createElement("canvas").getContext("webgl2");
	const facts = context?.getExtension("WEBGL_debug_renderer_info");
	const name = facts ? String(context!.getParameter(facts.UNMASKED_RENDERER_WEBGL)) : "";
	context?.getExtension("WEBGL_lose_context")?.loseContext();
	return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
