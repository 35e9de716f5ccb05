// A recording as the page holds it: what never changes, and the frames that were asked for lately.
import { isSaved } from "./saved";
import type { RunState, Source } from "./source";
import { uprightOf } from "./upright";

export type Body = {
	name: string;
	shape: string;
	kind: "surface" | "thread" | "points";
	nodes: number;
	cells: number;
	radius: number;
	is_closed: boolean;
	points: [first: number, count: number];
	triangles: [first: number, count: number];
};
export type Obstacle = { name: string; points: [number, number]; triangles: [number, number] };
export type Field = { name: string; unit: string; absent?: string };

// The value of points that have none.
export const isAbsent = (value: number) => value < -1e29;

const CACHE_BYTES = 128 << 20; // of all runs together

// Least recently used numbers go first.
class Cache {
	private entries = new Map<string, Promise<Float32Array>>();
	private sizes = new Map<string, number>();
	private bytes = 0;

	get(key: string, load: () => Promise<Float32Array>): Promise<Float32Array> {
		const known = this.entries.get(key);
		if (known) {
			this.entries.delete(key);
			this.entries.set(key, known);
			return known;
		}
		const loading = load();
		this.entries.set(key, loading);
		loading.then(
			(numbers) => this.count(key, numbers.byteLength),
			() => this.entries.delete(key),
		);
		return loading;
	}

	private count(key: string, size: number) {
		this.sizes.set(key, size);
		this.bytes += size;
		for (const oldest of this.entries.keys()) {
			if (this.bytes <= CACHE_BYTES || oldest === key) break;
			this.bytes -= this.sizes.get(oldest) ?? 0;
			this.sizes.delete(oldest);
			this.entries.delete(oldest);
		}
	}
}

const cache = new Cache();

export class Run {
	readonly name: string;
	readonly folder: string;
	readonly bodies: Body[];
	readonly obstacles: Obstacle[];
	readonly fields: Field[];
	readonly pointCount: number;
	readonly rest: Float32Array;
	readonly triangles: Int32Array;
	readonly obstaclePoints: Float32Array;
	readonly obstacleTriangles: Int32Array;
	readonly facts: Record<string, any>;
	readonly upright: ReturnType<typeof uprightOf>; // from the axes of the scene to those of the page
	times: number[];
	state!: RunState;
	summary: Record<string, any> = {};

	private constructor(
		private source: Source,
		readonly index: number,
		pack: { head: any; arrays: Record<string, any> },
	) {
		const { head, arrays } = pack;
		this.facts = head;
		this.name = head.name;
		this.folder = head.folder;
		this.bodies = head.bodies;
		this.obstacles = head.obstacles;
		this.fields = head.fields;
		this.pointCount = head.point_count;
		this.upright = uprightOf(head.gravity);
		this.rest = this.upright(arrays.rest);
		this.triangles = arrays.triangles;
		this.obstaclePoints = this.upright(arrays.obstacle_points);
		this.obstacleTriangles = arrays.obstacle_triangles;
		this.take(head);
		if (isSaved()) this.state.is_running = false;
		this.times = head.times;
	}

	static async open(source: Source, index: number): Promise<Run> {
		return new Run(source, index, await source.run(index));
	}

	private take(state: RunState) {
		this.state = state;
		try {
			this.summary = JSON.parse(state.summary ?? "{}");
		} catch {
			this.summary = {}; // of no use, but the run is
		}
	}

	get frameCount() {
		return this.times.length;
	}

	// Look for frames that were written since.
	async refresh(): Promise<boolean> {
		const state = await this.source.state(this.index, this.times.length);
		this.take(state);
		this.times.push(...state.times.slice(this.times.length - state.first));
		return state.times.length > 0;
	}

	// The frame that is shown at a time: the last one that is not later.
	frameAt(time: number): number {
		const slack = 1e-9 * Math.max(1, Math.abs(time));
		let low = 0;
		let high = this.times.length - 1;
		while (low < high) {
			const middle = (low + high + 1) >> 1;
			if (this.times[middle] <= time + slack) low = middle;
			else high = middle - 1;
		}
		return low;
	}

	positions(frame: number): Promise<Float32Array> {
		return cache.get(`${this.index}/${frame}`, async () =>
			this.upright(await this.source.positions(this.index, frame)),
		);
	}

	field(name: string, frame: number): Promise<Float32Array> {
		return cache.get(`${this.index}/${frame}/${name}`, async () =>
			name === "displacement"
				? lengths(await this.positions(frame), this.rest)
				: this.source.field(this.index, name, frame),
		);
	}

	series() {
		return this.source.series(this.index);
	}
}

function lengths(a: Float32Array, b: Float32Array): Float32Array {
	const out = new Float32Array(a.length / 3);
	for (let i = 0; i < out.length; ++i)
		out[i] = Math.hypot(a[3 * i] - b[3 * i], a[3 * i + 1] - b[3 * i + 1], a[3 * i + 2] - b[3 * i + 2]);
	return out;
}
