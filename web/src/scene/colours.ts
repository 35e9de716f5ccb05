// Colours of bodies, and maps from numbers to colours.
import { DataTexture, LinearFilter, RGBAFormat, SRGBColorSpace } from "three";

export const bodyColours = [0x4c8fd6, 0xe58b4a, 0x5fb37a, 0xc86fa5, 0xd9b63f, 0x7f78d2, 0x4fb3bf, 0xd66a5e];
export const obstacleColour = 0xc9cfd6;

// Points of the maps at equal distances, in sRGB.
const stops: Record<string, string[]> = {
	viridis: ["440154", "482878", "3e4a89", "31688e", "26828e", "1f9e89", "35b779", "6ece58", "b5de2b", "fde725"],
	magma: ["000004", "180f3d", "440f76", "721f81", "9e2f7f", "cd4071", "f1605d", "fd9668", "feca8d", "fcfdbf"],
	cividis: ["00224e", "123570", "3b496c", "575d6d", "707173", "8a8678", "a59c74", "c3b369", "e1cc55", "fee838"],
	turbo: ["30123b", "4662d7", "36aaf9", "1ae4b6", "72fe5e", "c7ef34", "faba39", "f66b19", "cb2a04", "7a0403"],
};
export const mapNames = Object.keys(stops);

const channel = (colour: string, i: number) => parseInt(colour.slice(2 * i, 2 * i + 2), 16);

// [r, g, b], 0 .. 255, at a share 0 .. 1 of the map.
export function colourAt(map: string, share: number): [number, number, number] {
	const list = stops[map];
	const place = Math.min(1, Math.max(0, share)) * (list.length - 1);
	const low = Math.min(list.length - 2, Math.floor(place));
	const mix = (i: number) => channel(list[low], i) + (place - low) * (channel(list[low + 1], i) - channel(list[low], i));
	return [mix(0), mix(1), mix(2)];
}

export function mapTexture(map: string): DataTexture {
	const width = 256;
	const data = new Uint8Array(4 * width);
	for (let i = 0; i < width; ++i) data.set([...colourAt(map, i / (width - 1)), 255], 4 * i);
	const texture = new DataTexture(data, width, 1, RGBAFormat);
	texture.colorSpace = SRGBColorSpace;
	texture.minFilter = texture.magFilter = LinearFilter;
	texture.needsUpdate = true;
	return texture;
}

export const mapGradient = (map: string) => `linear-gradient(to right, ${stops[map].map((stop) => `#${stop}`).join(", ")})`;
