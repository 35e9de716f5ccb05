// Where data come from: the command's server, or the page itself when it was saved.
import { readPack, type Pack } from "./pack";

export type RunEntry = { name: string; folder: string; error?: string };

export type RunState = {
	frame_count: number;
	first: number;
	times: number[];
	outcome: string;
	message: string;
	is_running: boolean;
	summary: string | null; // text of summary.json
};

export interface Source {
	runs(): Promise<RunEntry[]>;
	run(index: number): Promise<Pack>;
	series(index: number): Promise<Pack>;
	state(index: number, known: number): Promise<RunState>;
	positions(index: number, frame: number): Promise<Float32Array>;
	field(index: number, name: string, frame: number): Promise<Float32Array>;
}

const pause = (milliseconds: number) => new Promise((resolve) => setTimeout(resolve, milliseconds));

// The reason why there is no such field for this run.
export class Absent extends Error {}

// 503: the recording is being written at this moment.
async function ask(path: string): Promise<Response> {
	for (let attempt = 0; ; ++attempt) {
		const response = await fetch(path);
		if (response.ok) return response;
		if (response.status === 409) throw new Absent(await response.text());
		if (response.status !== 503 || attempt === 20) throw new Error(`${path}: ${response.status}`);
		await pause(100);
	}
}

const bytes = async (path: string) => (await ask(path)).arrayBuffer();

export class ServerSource implements Source {
	async runs() {
		return (await (await ask("/api/runs")).json()).runs as RunEntry[];
	}
	async run(index: number) {
		return readPack(await bytes(`/api/runs/${index}`));
	}
	async series(index: number) {
		return readPack(await bytes(`/api/runs/${index}/series`));
	}
	async state(index: number, known: number) {
		return (await (await ask(`/api/runs/${index}/state?known=${known}`)).json()) as RunState;
	}
	async positions(index: number, frame: number) {
		return new Float32Array(await bytes(`/api/runs/${index}/frames/${frame}`));
	}
	async field(index: number, name: string, frame: number) {
		return new Float32Array(await bytes(`/api/runs/${index}/fields/${name}/${frame}`));
	}
}
