// A run as a scene of three.js, showing one of its frames.
import { Box3, Color, Scene, Vector3 } from "three";
import type { Run } from "../data/run";
import { bodyColours } from "./colours";
import { Paint } from "./paint";
import { Ground, Lights, makeObstacles, type Look } from "./scenery";
import { makeShape, type Shape } from "./shapes";

const SAMPLES = 12; // frames that say how far things go

export class RunView {
	readonly scene = new Scene();
	readonly box: Box3; // of all that moves, over the sampled frames
	frame = -1;
	field = "";
	private shapes: Shape[];
	readonly lights: Lights;
	private ground: Ground | null = null;

	private constructor(
		readonly run: Run,
		readonly paint: Paint,
		box: Box3,
		look: Look,
	) {
		this.box = box;
		this.shapes = run.bodies.map((body, i) => makeShape(run, body, paint, bodyColours[i % bodyColours.length]));
		this.scene.add(...this.shapes.map((shape) => shape.object), ...makeObstacles(run, box));
		this.lights = new Lights(this.scene);
		this.lights.aim(box);
		if (run.obstacles.length === 0) this.ground = new Ground(this.scene, box, look);
		this.show(look);
	}

	static async create(run: Run, look: Look): Promise<RunView> {
		return new RunView(run, new Paint(), await boundsOf(run), look);
	}

	show(look: Look) {
		this.scene.background = new Color(look.background);
		this.ground?.show(look);
	}

	// A frame that was not there when the view was made: the ground stays under all, and the light about all.
	async grow(frame: number) {
		const before = this.box.clone();
		expand(this.box, await this.run.positions(frame));
		if (before.equals(this.box)) return;
		this.lights.aim(this.box);
		this.ground?.place(this.box);
	}

	// Both numbers of a frame, or none of them: what is drawn is always one frame.
	async load(frame: number): Promise<() => void> {
		const field = this.field;
		const [positions, values] = await Promise.all([
			this.run.positions(frame),
			field ? this.run.field(field, frame) : null,
		]);
		return () => {
			this.frame = frame;
			for (const shape of this.shapes) {
				shape.move(positions);
				if (values) shape.colour(values);
			}
		};
	}
}

// Some frames, evenly, with the first and the last.
export function sampleFrames(count: number, most = SAMPLES): number[] {
	if (count <= most) return Array.from({ length: count }, (_, i) => i);
	return Array.from({ length: most }, (_, i) => Math.round((i * (count - 1)) / (most - 1)));
}

function expand(box: Box3, positions: Float32Array) {
	const point = new Vector3();
	for (let i = 0; i < positions.length; i += 3) box.expandByPoint(point.fromArray(positions, i));
}

async function boundsOf(run: Run): Promise<Box3> {
	const box = new Box3();
	const frames = await Promise.all(sampleFrames(run.frameCount).map((frame) => run.positions(frame)));
	for (const positions of frames.length > 0 ? frames : [run.rest]) expand(box, positions);
	const radius = Math.max(0, ...run.bodies.map((body) => body.radius || 0));
	return box.isEmpty() ? new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1)) : box.expandByScalar(radius);
}
