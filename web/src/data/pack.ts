// The packs of app/view_pack.h: a JSON text and arrays of numbers in one piece.

type Numbers = Float32Array | Float64Array | Int32Array;
type Place = { type: "f32" | "f64" | "i32"; at: number; length: number };

const kinds = { f32: Float32Array, f64: Float64Array, i32: Int32Array };

export type Pack = { head: any; arrays: Record<string, Numbers> };

export function readPack(bytes: ArrayBuffer): Pack {
	const view = new DataView(bytes);
	if (bytes.byteLength < 8 || view.getUint32(0) !== 0x4a4e504b) throw new Error("these are no data of jounce");
	const end = 8 + view.getUint32(4, true);
	const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 8, end - 8)));
	const arrays: Record<string, Numbers> = {};
	for (const [name, place] of Object.entries(head.arrays as Record<string, Place>))
		arrays[name] = new kinds[place.type](bytes, end + place.at, place.length);
	return { head, arrays };
}
