// Pictures for `jounce render`: the command says which, in /api/job. Each is drawn larger than asked and averaged, which
// smooths its edges, gets its words, and is handed back.
import { write, type Words } from "./words";
import type { Point } from "./data/upright";
import type { Viewer } from "./viewer";

type Job = {
	width: number;
	height: number;
	samples: number; // along each side of a pixel, beside those of the renderer
	type: "raw" | "image/png" | "image/jpeg" | "image/webp"; // raw: red, green, blue, alpha, row by row from the top
	times: number[]; // [s]
	eye: Point | null; // in the axes of the first scene; instead of the camera of the address
	target: Point | null;
	words: Words;
};

const QUALITY = 0.9; // of what loses something

// The side of the command that takes what is made here.
class Desk {
	constructor(private key: string) {}

	private address(path: string) {
		return `/api/${path}?key=${encodeURIComponent(this.key)}`;
	}

	async job(): Promise<Job> {
		return (await fetch(this.address("job"))).json();
	}

	async hand(path: string, body: BodyInit) {
		const answer = await fetch(this.address(path), { method: "POST", body });
		if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
	}
}

function aim(viewer: Viewer, { eye, target }: Job) {
	if (!eye || !target) return;
	const { camera, controls } = viewer.stage;
	const { upright } = viewer.views[0].run;
	controls.target.set(...upright(target));
	camera.position.set(...upright(eye));
	controls.minDistance = 0;
	controls.maxDistance = Infinity;
	const distance = camera.position.distanceTo(controls.target);
	camera.near = distance / 100;
	camera.far = distance * 40;
	controls.update();
}

async function encode(paper: HTMLCanvasElement, pen: CanvasRenderingContext2D, type: Job["type"]): Promise<BodyInit> {
	if (type === "raw") return pen.getImageData(0, 0, paper.width, paper.height).data;
	const blob = await new Promise<Blob | null>((resolve) => paper.toBlob(resolve, type, QUALITY));
	if (!blob) throw new Error(`the browser writes no ${type}`);
	return blob;
}

async function draw(viewer: Viewer, job: Job, desk: Desk) {
	const paper = document.createElement("canvas");
	paper.width = job.width;
	paper.height = job.height;
	const pen = paper.getContext("2d", { alpha: false, willReadFrequently: true })!;
	pen.imageSmoothingQuality = "high";
	let sent: Promise<void> = Promise.resolve(); // one is under way while the next is drawn
	for (const [number, time] of job.times.entries()) {
		await viewer.playback.show(time);
		pen.drawImage(viewer.stage.canvas, 0, 0, job.width, job.height);
		write(pen, viewer, job.words, job.times);
		const body = await encode(paper, pen, job.type);
		await sent;
		sent = desk.hand(`pictures/${number}`, body);
	}
	await sent;
}

// `open` gives null when there is nothing to show.
export async function shoot(key: string, open: () => Promise<Viewer | null>) {
	const desk = new Desk(key);
	try {
		const job = await desk.job();
		const viewer = await open();
		if (!viewer) throw new Error("no recording can be opened");
		viewer.stage.resize(job.width, job.height, job.samples);
		await viewer.start();
		aim(viewer, job);
		await draw(viewer, job, desk);
		await desk.hand("done", "");
	} catch (error) {
		await desk.hand("failure", error instanceof Error ? error.message : String(error));
	}
}
