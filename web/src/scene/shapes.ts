// What the bodies of a run look like in three.js. Each shape is given positions and values of all drawn points of a run.
import {
	BufferAttribute,
	BufferGeometry,
	DoubleSide,
	DynamicDrawUsage,
	FrontSide,
	IcosahedronGeometry,
	InstancedBufferAttribute,
	InstancedMesh,
	Mesh,
	type Object3D,
} from "three";
import type { Body, Run } from "../data/run";
import { splitAtEdges, vertexNormals } from "./crease";
import type { Paint } from "./paint";
import { Tube } from "./tube";

export interface Shape {
	object: Object3D;
	move(positions: Float32Array): void;
	colour(values: Float32Array): void;
}

const dynamic = (array: Float32Array, size: number) => new BufferAttribute(array, size).setUsage(DynamicDrawUsage);

// The back of what is closed is not seen, and need not be drawn.
function makeMesh(geometry: BufferGeometry, paint: Paint, colour: number, isClosed: boolean): Mesh {
	const mesh = new Mesh(geometry, paint.material(colour, isClosed ? FrontSide : DoubleSide));
	mesh.castShadow = mesh.receiveShadow = true;
	mesh.frustumCulled = false; // its bounds change with every frame
	return mesh;
}

const MOST_CORNERS = 3e6;

// Does every edge have two triangles, one in each direction?
function isClosed(corners: ArrayLike<number>): boolean {
	if (corners.length > MOST_CORNERS) return false; // not worth the time
	const open = new Set<number>();
	const limit = 2 ** 26;
	for (let t = 0; t < corners.length; t += 3)
		for (let side = 0; side < 3; ++side) {
			const [a, b] = [corners[t + side], corners[t + ((side + 1) % 3)]];
			if (!open.delete(b * limit + a)) open.add(a * limit + b);
		}
	return open.size === 0;
}

function makeSurface(run: Run, body: Body, paint: Paint, colour: number): Shape {
	const triangles = run.triangles.subarray(3 * body.triangles[0], 3 * (body.triangles[0] + body.triangles[1]));
	const { source, index } = splitAtEdges(triangles, run.rest, body.points[0], body.points[1]);
	const geometry = new BufferGeometry();
	const positions = new Float32Array(3 * source.length);
	const normals = new Float32Array(3 * source.length);
	const values = new Float32Array(source.length);
	geometry.setAttribute("position", dynamic(positions, 3));
	geometry.setAttribute("normal", dynamic(normals, 3));
	geometry.setAttribute("value", dynamic(values, 1));
	geometry.setIndex(new BufferAttribute(index, 1));
	return {
		object: makeMesh(geometry, paint, colour, isClosed(triangles)),
		move(points) {
			for (let i = 0; i < source.length; ++i) {
				positions[3 * i] = points[3 * source[i]];
				positions[3 * i + 1] = points[3 * source[i] + 1];
				positions[3 * i + 2] = points[3 * source[i] + 2];
			}
			vertexNormals(index, positions, normals);
			geometry.attributes.position.needsUpdate = geometry.attributes.normal.needsUpdate = true;
		},
		colour(numbers) {
			for (let i = 0; i < source.length; ++i) values[i] = numbers[source[i]];
			geometry.attributes.value.needsUpdate = true;
		},
	};
}

function makeThread(body: Body, paint: Paint, colour: number): Shape {
	const tube = new Tube(body.points[1], body.radius, body.is_closed);
	const [first, count] = body.points;
	return {
		object: makeMesh(tube.geometry, paint, colour, true),
		move: (points) => tube.move(points.subarray(3 * first, 3 * (first + count))),
		colour: (values) => tube.colour(values.subarray(first, first + count)),
	};
}

// Half the distance of a point's nearest neighbours, for recordings that do not say how large points are.
function guessRadius(run: Run, body: Body): number {
	const [first, count] = body.points;
	let nearest = Infinity;
	const at = (i: number, axis: number) => run.rest[3 * (first + i) + axis];
	for (let i = 1; i < Math.min(count, 5000); ++i)
		nearest = Math.min(nearest, Math.hypot(at(i, 0) - at(0, 0), at(i, 1) - at(0, 1), at(i, 2) - at(0, 2)));
	return Number.isFinite(nearest) ? nearest / 2 : 0.02;
}

function makePoints(run: Run, body: Body, paint: Paint, colour: number): Shape {
	const [first, count] = body.points;
	const radius = body.radius > 0 ? body.radius : guessRadius(run, body);
	const ball = new IcosahedronGeometry(1.15 * radius, count < 2000 ? 3 : count < 20000 ? 1 : 0);
	const normal = ball.attributes.position.clone(); // of a ball about the origin
	const geometry = ball.setAttribute("normal", normal);
	const values = new Float32Array(count);
	geometry.setAttribute("value", new InstancedBufferAttribute(values, 1).setUsage(DynamicDrawUsage));
	const mesh = new InstancedMesh(geometry, paint.material(colour, FrontSide), count);
	mesh.castShadow = mesh.receiveShadow = true;
	mesh.frustumCulled = false;
	mesh.instanceMatrix.setUsage(DynamicDrawUsage);
	const matrices = mesh.instanceMatrix.array as Float32Array;
	for (let i = 0; i < count; ++i) matrices.set([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], 16 * i);
	return {
		object: mesh,
		move(points) {
			for (let i = 0; i < count; ++i)
				for (let axis = 0; axis < 3; ++axis) matrices[16 * i + 12 + axis] = points[3 * (first + i) + axis];
			mesh.instanceMatrix.needsUpdate = true;
		},
		colour(numbers) {
			values.set(numbers.subarray(first, first + count));
			geometry.attributes.value.needsUpdate = true;
		},
	};
}

export function makeShape(run: Run, body: Body, paint: Paint, colour: number): Shape {
	if (body.kind === "thread") return makeThread(body, paint, colour);
	if (body.kind === "points") return makePoints(run, body, paint, colour);
	return makeSurface(run, body, paint, colour);
}
