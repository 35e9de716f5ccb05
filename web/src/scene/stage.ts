// One canvas for all runs: each has a part of it, and all are seen by the same camera.
import { Box3, Color, MathUtils, PerspectiveCamera, Spherical, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { RunView } from "./run_view";
import { Quality, isSoftware, type Level } from "./quality";
import { prepareRenderer, setShadows, type Look } from "./scenery";

export const looks: Record<"light" | "dark", Look> = {
	light: { background: new Color(0xf2f4f7), grid: new Color(0x6b7785) },
	dark: { background: new Color(0x15181d), grid: new Color(0x8a97a8) },
};

export type CameraChoice = { azimuth: number; elevation: number; zoom: number }; // [degrees], 1: all is seen

const REST = 350; // [ms] without motion, before a picture is drawn better
const exact: Level = { ratio: 1, isSoft: true, shadowSize: 4096, shadowEvery: 1 };

export class Stage {
	readonly renderer: WebGLRenderer;
	readonly camera = new PerspectiveCamera(32, 1, 0.01, 100);
	readonly controls: OrbitControls;
	views: RunView[] = [];
	drawnCount = 0; // pictures
	private isDue = false;
	private quality: Quality;
	private size = { width: 1, height: 1, ratio: 1 };
	private level: Level | null = null; // of what is drawn now
	private rest = 0; // timer that ends a motion; 0: nothing moves
	private isPlaying = false;
	private lastMove = 0; // [ms]
	private drawn = 0; // pictures since the level was chosen

	// `isExact`: every picture is drawn as well as can be.
	constructor(
		readonly canvas: HTMLCanvasElement,
		private isExact: boolean,
	) {
		const isSlow = !isExact && isSoftware();
		this.quality = new Quality(isSlow);
		this.renderer = new WebGLRenderer({ canvas, antialias: !isSlow });
		prepareRenderer(this.renderer);
		this.controls = new OrbitControls(this.camera, canvas);
		this.controls.addEventListener("change", () => {
			this.hurry();
			this.request();
		});
	}

	// The next pictures are some of many; when no more come, the last one is drawn again, and better.
	hurry() {
		if (this.isExact) return;
		const now = performance.now();
		if (this.isPlaying || this.rest !== 0) this.quality.note(now - this.lastMove);
		this.lastMove = now;
		clearTimeout(this.rest);
		this.rest = window.setTimeout(() => this.settle(), REST);
	}

	// Between begin and end everything moves, however long a picture takes.
	begin() {
		this.isPlaying = !this.isExact;
		this.lastMove = performance.now();
	}

	end() {
		this.isPlaying = false;
		this.hurry();
	}

	private settle() {
		this.rest = 0;
		if (!this.isPlaying) this.draw();
	}

	private choose() {
		const isMoving = this.isPlaying || this.rest !== 0;
		const level = this.isExact ? exact : isMoving ? this.quality.moving : this.quality.resting;
		if (level === this.level) return;
		this.level = level;
		this.drawn = 0;
		setShadows(this.renderer, this.views, level.isSoft, level.shadowSize);
		this.setSize();
	}

	private setSize() {
		const { width, height, ratio } = this.size;
		this.renderer.setPixelRatio(ratio * (this.level?.ratio ?? 1));
		this.renderer.setSize(width, height, false);
	}

	// Draw before the next picture of the browser.
	request() {
		if (this.isDue) return;
		this.isDue = true;
		requestAnimationFrame(() => this.draw());
	}

	resize(width: number, height: number, ratio: number) {
		this.size = { width, height, ratio };
		this.setSize();
		this.request();
	}

	// Columns and rows of the parts: as square as they can be.
	parts(): { left: number; top: number; width: number; height: number }[] {
		const { width, height } = this.size;
		const count = Math.max(1, this.views.length);
		let columns = 1;
		const badness = (n: number) => Math.abs(Math.log(width / n / (height / Math.ceil(count / n)) / 1.3));
		for (let n = 2; n <= count; ++n) if (badness(n) < badness(columns)) columns = n;
		const rows = Math.ceil(count / columns);
		return this.views.map((_, i) => ({
			left: ((i % columns) * width) / columns,
			top: (Math.floor(i / columns) * height) / rows,
			width: width / columns,
			height: height / rows,
		}));
	}

	draw() {
		this.isDue = false;
		this.choose();
		this.renderer.shadowMap.autoUpdate = this.drawn++ % (this.level?.shadowEvery ?? 1) === 0;
		const { height } = this.size;
		this.parts().forEach((part, i) => {
			const bottom = height - part.top - part.height;
			this.camera.aspect = part.width / part.height;
			this.camera.updateProjectionMatrix();
			this.renderer.setViewport(part.left, bottom, part.width, part.height);
			this.renderer.setScissor(part.left, bottom, part.width, part.height);
			this.renderer.render(this.views[i].scene, this.camera);
		});
		++this.drawnCount;
	}

	// Draw as well as can be, even while things move.
	drawBest() {
		clearTimeout(this.rest);
		this.rest = 0;
		this.draw();
	}

	// See all of all runs, from where one sees most of them.
	fit(choice: Partial<CameraChoice> = {}) {
		const box = new Box3();
		for (const view of this.views) box.union(view.box);
		const size = box.getSize(new Vector3());
		const azimuth = ((choice.azimuth ?? (size.x >= size.z ? 28 : 62)) * Math.PI) / 180;
		const elevation = ((choice.elevation ?? 18) * Math.PI) / 180;
		const away = new Vector3(
			Math.sin(azimuth) * Math.cos(elevation),
			Math.sin(elevation),
			Math.cos(azimuth) * Math.cos(elevation),
		);
		this.controls.target.copy(box.getCenter(new Vector3()));
		const distance = this.distanceFor(box, away) / (choice.zoom ?? 1);
		this.camera.position.copy(this.controls.target).addScaledVector(away, distance);
		this.camera.near = distance / 100;
		this.camera.far = distance * 20;
		this.controls.minDistance = distance / 80;
		this.controls.maxDistance = distance * 12;
		this.controls.update();
		this.request();
	}

	// Turn about the target [degrees].
	orbit(azimuth: number, elevation: number) {
		const offset = this.camera.position.clone().sub(this.controls.target);
		const place = new Spherical().setFromVector3(offset);
		place.theta += MathUtils.degToRad(azimuth);
		place.phi -= MathUtils.degToRad(elevation);
		place.makeSafe();
		this.camera.position.copy(this.controls.target).add(offset.setFromSpherical(place));
		this.controls.update();
		this.request();
	}

	zoom(factor: number) {
		const offset = this.camera.position.clone().sub(this.controls.target).divideScalar(factor);
		this.camera.position.copy(this.controls.target).add(offset);
		this.controls.update();
		this.request();
	}

	// How far away all corners of a box are within the picture, with a margin.
	private distanceFor(box: Box3, away: Vector3): number {
		const part = this.parts()[0] ?? { width: 1, height: 1 };
		const up = Math.tan((this.camera.fov * Math.PI) / 360) / 1.12;
		const across = (up * part.width) / part.height;
		const right = new Vector3(0, 1, 0).cross(away).normalize();
		const above = away.clone().cross(right);
		const centre = box.getCenter(new Vector3());
		let distance = 1e-6;
		for (let corner = 0; corner < 8; ++corner) {
			const at = new Vector3(
				corner & 1 ? box.max.x : box.min.x,
				corner & 2 ? box.max.y : box.min.y,
				corner & 4 ? box.max.z : box.min.z,
			).sub(centre);
			const depth = at.dot(away);
			distance = Math.max(distance, depth + Math.abs(at.dot(right)) / across, depth + Math.abs(at.dot(above)) / up);
		}
		return distance;
	}
}
