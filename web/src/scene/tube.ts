// A round tube about a line of points, with round ends. Its rings are carried along without twist.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Vector3 } from "three";

const SIDES = 10;
const CAP_RINGS = 3; // of each round end, beside the ring at the end itself

type Ring = {
	point: number;
	frame: number; // whose vectors across it has; those of the ring that closes a tube are its own
	along: number; // how far beyond the point, in radii
	width: number; // its own radius, in radii
};

function ringsOf(count: number, isClosed: boolean): Ring[] {
	const rings: Ring[] = [];
	const cap = (point: number, sign: number) =>
		Array.from({ length: CAP_RINGS }, (_, k) => {
			const angle = ((k + 1) / CAP_RINGS) * (Math.PI / 2);
			return { point, frame: point, along: sign * Math.sin(angle), width: Math.cos(angle) };
		});
	if (!isClosed) rings.push(...cap(0, -1).reverse());
	for (let point = 0; point < count; ++point) rings.push({ point, frame: point, along: 0, width: 1 });
	rings.push(...(isClosed ? [{ point: 0, frame: count, along: 0, width: 1 }] : cap(count - 1, 1)));
	return rings;
}

export class Tube {
	readonly geometry = new BufferGeometry();
	private rings: Ring[];
	private positions: Float32Array;
	private normals: Float32Array;
	private values: Float32Array;

	constructor(
		private count: number,
		private radius: number,
		private isClosed: boolean,
	) {
		this.rings = ringsOf(count, isClosed);
		const vertices = this.rings.length * SIDES;
		this.positions = new Float32Array(3 * vertices);
		this.normals = new Float32Array(3 * vertices);
		this.values = new Float32Array(vertices);
		const attribute = (array: Float32Array, size: number) => new BufferAttribute(array, size).setUsage(DynamicDrawUsage);
		this.geometry.setAttribute("position", attribute(this.positions, 3));
		this.geometry.setAttribute("normal", attribute(this.normals, 3));
		this.geometry.setAttribute("value", attribute(this.values, 1));
		this.geometry.setIndex(this.faces());
	}

	private faces(): number[] {
		const index: number[] = [];
		for (let ring = 0; ring + 1 < this.rings.length; ++ring)
			for (let side = 0; side < SIDES; ++side) {
				const a = ring * SIDES + side;
				const b = ring * SIDES + ((side + 1) % SIDES);
				index.push(a, b, a + SIDES, b, b + SIDES, a + SIDES);
			}
		return index;
	}

	move(points: Float32Array) {
		const at = (i: number) => new Vector3().fromArray(points, 3 * i);
		const across = new Vector3();
		const tangents = Array.from({ length: this.count }, (_, i) => this.tangent(at, i));
		const sides: Vector3[] = [];
		const start = tangents[0];
		across.set(Math.abs(start.x) < 0.7 ? 1 : 0, Math.abs(start.x) < 0.7 ? 0 : 1, 0);
		for (const tangent of [...tangents, start]) {
			across.addScaledVector(tangent, -across.dot(tangent)).normalize();
			sides.push(across.clone());
		}
		this.rings.forEach((ring, k) => this.place(k, ring, at(ring.point), tangents[ring.point], sides[ring.frame]));
		this.geometry.attributes.position.needsUpdate = this.geometry.attributes.normal.needsUpdate = true;
	}

	private tangent(at: (i: number) => Vector3, i: number): Vector3 {
		const last = this.count - 1;
		const before = i > 0 ? i - 1 : this.isClosed ? last : 0;
		const behind = i < last ? i + 1 : this.isClosed ? 0 : last;
		const tangent = at(behind).sub(at(before));
		return tangent.lengthSq() > 0 ? tangent.normalize() : new Vector3(0, 1, 0);
	}

	private place(k: number, ring: Ring, centre: Vector3, tangent: Vector3, side: Vector3) {
		const other = new Vector3().crossVectors(tangent, side);
		const normal = new Vector3();
		for (let s = 0; s < SIDES; ++s) {
			const angle = (2 * Math.PI * s) / SIDES;
			normal.set(0, 0, 0).addScaledVector(side, Math.cos(angle)).addScaledVector(other, Math.sin(angle));
			normal.multiplyScalar(ring.width).addScaledVector(tangent, ring.along);
			const to = 3 * (k * SIDES + s);
			normal.toArray(this.normals, to);
			normal.multiplyScalar(this.radius).add(centre).toArray(this.positions, to);
		}
	}

	colour(values: Float32Array) {
		this.rings.forEach((ring, k) => this.values.fill(values[ring.point], k * SIDES, (k + 1) * SIDES));
		this.geometry.attributes.value.needsUpdate = true;
	}
}
