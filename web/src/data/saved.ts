// Data inside the page itself: the pieces of app/view_save.h, in the coding of app/view_code.h.
import { readPack } from "./pack";
import type { RunEntry, RunState, Source } from "./source";
import { Absent } from "./source";

export const isSaved = () => document.getElementById("runs") !== null;

async function inflate(id: string): Promise<ArrayBuffer> {
	const text = document.getElementById(id)?.textContent;
	if (!text) throw new Absent("it was not saved with this page");
	const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
	return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
}

const ABSENT = -1e30;

// Numbers of `parts` columns, from codes that are differences, low bytes before high ones.
function decode(bytes: ArrayBuffer, parts: number): Float32Array {
	const head = new Float32Array(bytes, 0, 2 * parts);
	const codes = (bytes.byteLength - head.byteLength) / 2;
	const low = new Uint8Array(bytes, head.byteLength, codes);
	const high = new Uint8Array(bytes, head.byteLength + codes, codes);
	const count = codes / parts;
	const out = new Float32Array(codes);
	for (let part = 0; part < parts; ++part)
		for (let i = 0, code = 0, at = part * count; i < count; ++i, ++at) {
			code = (code + low[at] + 256 * high[at]) & 0xffff;
			out[i * parts + part] = code === 0 ? ABSENT : head[2 * part] + head[2 * part + 1] * (code - 1);
		}
	return out;
}

export class SavedSource implements Source {
	async runs() {
		return JSON.parse(new TextDecoder().decode(await inflate("runs"))).runs as RunEntry[];
	}
	async run(index: number) {
		return readPack(await inflate(`${index}`));
	}
	async series(index: number) {
		return readPack(await inflate(`${index}/series`));
	}
	async state(): Promise<RunState> {
		throw new Error("a saved page does not change");
	}
	async positions(index: number, frame: number) {
		return decode(await inflate(`${index}/frames/${frame}`), 3);
	}
	async field(index: number, name: string, frame: number) {
		return decode(await inflate(`${index}/fields/${name}/${frame}`), 1);
	}
}
