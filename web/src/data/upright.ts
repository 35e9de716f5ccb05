// Up is y in the page, whatever it is in the scene: against gravity, along the nearest axis; y without gravity.

type Row = [axis: 0 | 1 | 2, sign: 1 | -1]; // where a coordinate comes from
export type Point = [x: number, y: number, z: number];

// Quarter turns about z or x, or half a turn about x; by the axis that is up: along it, or against it.
const turns: [along: Row[], against: Row[]][] = [
	[[[1, -1], [0, 1], [2, 1]], [[1, 1], [0, -1], [2, 1]]],
	[[[0, 1], [1, 1], [2, 1]], [[0, 1], [1, -1], [2, -1]]],
	[[[0, 1], [2, 1], [1, -1]], [[0, 1], [2, -1], [1, 1]]],
];

function turnOf(gravity: Point): Row[] {
	let up = 1;
	for (const axis of [0, 2]) if (Math.abs(gravity[axis]) > Math.abs(gravity[up])) up = axis;
	return turns[up][gravity[up] > 0 ? 1 : 0];
}

// Turns points, one behind the other, in place.
export function uprightOf(gravity: Point): <T extends Float32Array | Point>(points: T) => T {
	const [[a, signA], [b, signB], [c, signC]] = turnOf(gravity);
	if (a === 0 && b === 1 && signB === 1) return (points) => points;
	return (points) => {
		for (let i = 0; i < points.length; i += 3) {
			const at = [points[i], points[i + 1], points[i + 2]];
			points[i] = signA * at[a];
			points[i + 1] = signB * at[b];
			points[i + 2] = signC * at[c];
		}
		return points;
	};
}
