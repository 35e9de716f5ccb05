// Light, ground and obstacles about a run.
import {
	Box3,
	BufferAttribute,
	BufferGeometry,
	CircleGeometry,
	Color,
	DirectionalLight,
	HemisphereLight,
	Mesh,
	MeshStandardMaterial,
	BasicShadowMap,
	PCFShadowMap,
	PlaneGeometry,
	Scene,
	ShaderMaterial,
	ShadowMaterial,
	Vector3,
	type WebGLRenderer,
} from "three";
import type { Run } from "../data/run";
import { obstacleColour } from "./colours";

export type Look = { background: Color; grid: Color };

export function prepareRenderer(renderer: WebGLRenderer) {
	renderer.shadowMap.enabled = true;
	renderer.shadowMap.type = PCFShadowMap;
	renderer.setScissorTest(true);
}

// Materials are compiled for one kind of shadow.
export function setShadows(renderer: WebGLRenderer, views: { scene: Scene; lights: Lights }[], isSoft: boolean, size: number) {
	const type = isSoft ? PCFShadowMap : BasicShadowMap;
	const isOther = type !== renderer.shadowMap.type;
	renderer.shadowMap.type = type;
	for (const { scene, lights } of views) {
		lights.setShadow(size);
		if (isOther) scene.traverse((object) => object instanceof Mesh && (object.material.needsUpdate = true));
	}
}

// To the key light.
export const keyDirection = new Vector3(0.45, 1, 0.6).normalize();

// A key light with a soft shadow, a fill light from the other side, and the sky.
export class Lights {
	readonly key = new DirectionalLight(0xfff4e6, 2.4);
	readonly fill = new DirectionalLight(0xdfe9ff, 0.7);
	readonly sky = new HemisphereLight(0xf4f8ff, 0x8c8478, 1.35);

	constructor(scene: Scene) {
		this.key.castShadow = true;
		scene.add(this.key, this.key.target, this.fill, this.sky);
	}

	setShadow(size: number) {
		const { shadow } = this.key;
		shadow.mapSize.set(size, size);
		shadow.radius = (5 * size) / 2048; // the same width of the edge
		shadow.map?.dispose();
		shadow.map = null;
	}

	// The shadow's camera holds the box.
	aim(box: Box3) {
		const centre = box.getCenter(new Vector3());
		const radius = Math.max(1e-6, box.getSize(new Vector3()).length() / 2);
		this.key.position.copy(centre).addScaledVector(keyDirection, 4 * radius);
		this.key.target.position.copy(centre);
		this.fill.position.copy(centre).add(new Vector3(-1, 0.4, -0.7).multiplyScalar(radius));
		this.fill.target.position.copy(centre);
		const camera = this.key.shadow.camera;
		camera.left = camera.bottom = -1.15 * radius;
		camera.right = camera.top = 1.15 * radius;
		camera.near = 2 * radius;
		camera.far = 6.5 * radius;
		camera.updateProjectionMatrix();
		this.key.shadow.normalBias = 0.02 * radius;
		this.key.shadow.bias = -0.0005;
	}
}

const gridVertex = `
uniform float reach;
varying vec2 place;
void main() {
	place = position.xy * reach;
	gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// Lines a cell apart, every fifth stronger, that fade out with the distance from the middle.
const gridFragment = `
uniform vec3 colour;
uniform float cell, reach;
varying vec2 place;
float line(float size, vec2 step) {
	vec2 at = place / size;
	vec2 width = step / size;
	vec2 near = 1.0 - smoothstep(vec2(0.0), 1.4 * width, abs(fract(at - 0.5) - 0.5));
	return max(near.x, near.y) * (1.0 - smoothstep(0.15, 0.5, max(width.x, width.y)));
}
void main() {
	float fade = 1.0 - smoothstep(0.15, 1.0, length(place) / reach);
	vec2 step = fwidth(place);
	gl_FragColor = vec4(colour, fade * max(0.16 * line(cell, step), 0.4 * line(5.0 * cell, step)));
}`;

// 1, 2 or 5 times a power of ten, some fifteenth of a length: of a grid that can be read.
function cellOf(size: number): number {
	const wanted = Math.max(size, 1e-9) / 15;
	const power = 10 ** Math.floor(Math.log10(wanted));
	return power * [5, 2, 1].find((digit) => digit * power <= wanted)!;
}

// Where the shadow of a box falls on the level `y`: what is outside needs no look at the shadow map.
function shadowOf(box: Box3, y: number): Box3 {
	const fallen = new Box3();
	for (let corner = 0; corner < 8; ++corner) {
		const [a, b, c] = [corner & 1, corner & 2, corner & 4].map((bit) => (bit ? box.max : box.min));
		const point = new Vector3(a.x, b.y, c.z);
		fallen.expandByPoint(point.addScaledVector(keyDirection, (y - point.y) / keyDirection.y));
	}
	return fallen.expandByScalar(0.05 * box.getSize(new Vector3()).length()); // soft edges
}

// A floor that shows nothing but shadows and a grid, under all that ever moves.
export class Ground {
	private shadow: Mesh;
	private grid: Mesh;

	constructor(scene: Scene, box: Box3, look: Look) {
		this.shadow = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial({ opacity: 0.28 }));
		this.shadow.receiveShadow = true;
		this.grid = new Mesh(
			new CircleGeometry(1, 64),
			new ShaderMaterial({
				uniforms: { colour: { value: look.grid }, cell: { value: 1 }, reach: { value: 1 } },
				vertexShader: gridVertex,
				fragmentShader: gridFragment,
				transparent: true,
				depthWrite: false,
			}),
		);
		for (const mesh of [this.shadow, this.grid]) mesh.rotation.x = -Math.PI / 2;
		scene.add(this.shadow, this.grid);
		this.place(box);
	}

	// Under a box.
	place(box: Box3) {
		const size = box.getSize(new Vector3()).length();
		const centre = box.getCenter(new Vector3());
		const { uniforms } = this.grid.material as ShaderMaterial;
		uniforms.reach.value = 4 * size;
		uniforms.cell.value = cellOf(size);
		this.grid.position.set(centre.x, box.min.y - 0.0015 * size, centre.z);
		this.grid.scale.setScalar(4 * size);
		const fallen = shadowOf(box, box.min.y - 0.002 * size);
		const extent = fallen.getSize(new Vector3());
		fallen.getCenter(this.shadow.position).setY(box.min.y - 0.002 * size);
		this.shadow.scale.set(extent.x, extent.z, 1);
	}

	show(look: Look) {
		(this.grid.material as ShaderMaterial).uniforms.colour.value = look.grid;
	}
}

// Floors are far larger than what moves on them: they fade into the background before one sees their end.
function fade(material: MeshStandardMaterial, geometry: BufferGeometry, box: Box3) {
	const extent = geometry.boundingBox!.getSize(new Vector3());
	const reach = 0.5 * Math.min(extent.x, extent.z);
	if (reach < box.getSize(new Vector3()).length()) return;
	const uniforms = { middle: { value: box.getCenter(new Vector3()) }, reach: { value: reach } };
	material.transparent = true;
	material.onBeforeCompile = (shader) => {
		Object.assign(shader.uniforms, uniforms);
		shader.vertexShader = shader.vertexShader
			.replace("#include <common>", "#include <common>\nvarying vec3 vPlace;")
			.replace("#include <begin_vertex>", "#include <begin_vertex>\nvPlace = (modelMatrix * vec4(position, 1.0)).xyz;");
		shader.fragmentShader = shader.fragmentShader
			.replace("#include <common>", "#include <common>\nuniform vec3 middle;\nuniform float reach;\nvarying vec3 vPlace;")
			.replace(
				"#include <opaque_fragment>",
				"diffuseColor.a = 1.0 - smoothstep(0.15, 0.95, distance(vPlace.xz, middle.xz) / reach);\n#include <opaque_fragment>",
			);
	};
}

export function makeObstacles(run: Run, box: Box3): Mesh[] {
	return run.obstacles.map((obstacle) => {
		const geometry = new BufferGeometry();
		const [first, count] = obstacle.triangles;
		geometry.setAttribute("position", new BufferAttribute(run.obstaclePoints, 3));
		geometry.setIndex(new BufferAttribute(Uint32Array.from(run.obstacleTriangles.subarray(3 * first, 3 * (first + count))), 1));
		const flat = geometry.toNonIndexed();
		flat.computeVertexNormals();
		flat.computeBoundingBox();
		const material = new MeshStandardMaterial({ color: obstacleColour, roughness: 0.9 }); // one looks into a bowl from below
		fade(material, flat, box);
		const mesh = new Mesh(flat, material);
		mesh.castShadow = !flat.boundingBox!.containsBox(box); // what holds all would let in no light
		mesh.receiveShadow = true;
		mesh.name = obstacle.name;
		return mesh;
	});
}
