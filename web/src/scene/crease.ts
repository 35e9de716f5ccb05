// Smooth where a surface is smooth at rest, sharp where it has an edge: points are split along edges, so that each side has
// its own normal.

const SHARPEST = Math.cos((40 * Math.PI) / 180);

export type Split = {
	source: Int32Array; // the point behind each vertex
	index: Uint32Array; // triangles of vertices
};

function normalsOf(triangles: Int32Array, points: Float32Array): Float32Array {
	const out = new Float32Array(triangles.length);
	for (let t = 0; t < triangles.length; t += 3) {
		const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
		const [ux, uy, uz] = [points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]];
		const [vx, vy, vz] = [points[c] - points[a], points[c + 1] - points[a + 1], points[c + 2] - points[a + 2]];
		const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
		const length = Math.hypot(x, y, z) || 1;
		out.set([x / length, y / length, z / length], t);
	}
	return out;
}

// Corners at each point, as lists: corners of point p are list[ends[p - 1]] .. list[ends[p] - 1].
function cornersByPoint(triangles: Int32Array, first: number, count: number) {
	const ends = new Int32Array(count + 1);
	for (const point of triangles) ++ends[point - first + 1];
	for (let p = 0; p < count; ++p) ends[p + 1] += ends[p];
	const next = ends.slice();
	const list = new Int32Array(triangles.length);
	triangles.forEach((point, corner) => (list[next[point - first]++] = corner));
	return { ends, list };
}

// `triangles` name points `first` .. `first + count - 1` of `points` at rest.
export function splitAtEdges(triangles: Int32Array, points: Float32Array, first: number, count: number): Split {
	const normals = normalsOf(triangles, points);
	const { ends, list } = cornersByPoint(triangles, first, count);
	const index = new Uint32Array(triangles.length);
	const source: number[] = [];
	const groups: { normal: number[]; vertex: number }[] = [];
	for (let p = 0; p < count; ++p) {
		groups.length = 0;
		for (let i = ends[p]; i < ends[p + 1]; ++i) {
			const corner = list[i];
			const n = 3 * Math.floor(corner / 3);
			const cosine = (m: number[]) => m[0] * normals[n] + m[1] * normals[n + 1] + m[2] * normals[n + 2];
			let group = groups.find((known) => cosine(known.normal) > SHARPEST);
			if (!group) {
				group = { normal: [normals[n], normals[n + 1], normals[n + 2]], vertex: source.length };
				groups.push(group);
				source.push(first + p);
			}
			index[corner] = group.vertex;
		}
	}
	return { source: Int32Array.from(source), index };
}

// Normals of vertices: sums of those of their triangles, weighted by area.
export function vertexNormals(index: Uint32Array, positions: Float32Array, normals: Float32Array) {
	normals.fill(0);
	for (let t = 0; t < index.length; t += 3) {
		const a = 3 * index[t];
		const b = 3 * index[t + 1];
		const c = 3 * index[t + 2];
		const ux = positions[b] - positions[a];
		const uy = positions[b + 1] - positions[a + 1];
		const uz = positions[b + 2] - positions[a + 2];
		const vx = positions[c] - positions[a];
		const vy = positions[c + 1] - positions[a + 1];
		const vz = positions[c + 2] - positions[a + 2];
		const x = uy * vz - uz * vy;
		const y = uz * vx - ux * vz;
		const z = ux * vy - uy * vx;
		normals[a] += x;
		normals[a + 1] += y;
		normals[a + 2] += z;
		normals[b] += x;
		normals[b + 1] += y;
		normals[b + 2] += z;
		normals[c] += x;
		normals[c + 1] += y;
		normals[c + 2] += z;
	}
	for (let i = 0; i < normals.length; i += 3) {
		const length = Math.sqrt(normals[i] ** 2 + normals[i + 1] ** 2 + normals[i + 2] ** 2) || 1;
		normals[i] /= length;
		normals[i + 1] /= length;
		normals[i + 2] /= length;
	}
}
