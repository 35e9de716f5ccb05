// One material for all that moves: its own colour, or a field by a colour map. The field is interpolated before the map is
// looked up, so that the colour of every pixel is one of the legend's.
import { Color, MeshStandardMaterial, type DataTexture, type Side } from "three";
import { mapTexture } from "./colours";
import { keyDirection } from "./scenery";

// Shadows are looked up a little off the surface, on the side of the light also where a sheet's normal points away from it.
const towardsLight = `
vec3 worldNormal = transformNormalByInverseViewMatrix(transformedNormal, viewMatrix);
if (dot(worldNormal, vec3(${keyDirection.toArray().join(", ")})) < 0.0) transformedNormal = -transformedNormal;
#include <shadowmap_vertex>`;

export class Paint {
	private uniforms = {
		colourMap: { value: mapTexture("viridis") as DataTexture },
		low: { value: 0 },
		scale: { value: 1 },
		isMapped: { value: false },
	};

	setMap(name: string) {
		this.uniforms.colourMap.value.dispose();
		this.uniforms.colourMap.value = mapTexture(name);
	}

	setRange(low: number, high: number) {
		this.uniforms.low.value = low;
		this.uniforms.scale.value = high > low ? 1 / (high - low) : 0;
	}

	set isMapped(value: boolean) {
		this.uniforms.isMapped.value = value;
	}

	material(colour: number, side: Side): MeshStandardMaterial {
		const material = new MeshStandardMaterial({ color: new Color(colour), roughness: 0.62, metalness: 0, side, shadowSide: side });
		material.onBeforeCompile = (shader) => {
			Object.assign(shader.uniforms, this.uniforms);
			shader.vertexShader = shader.vertexShader
				.replace("#include <common>", "#include <common>\nattribute float value;\nvarying float vValue;")
				.replace("#include <begin_vertex>", "#include <begin_vertex>\nvValue = value;")
				.replace("#include <shadowmap_vertex>", towardsLight);
			shader.fragmentShader = shader.fragmentShader
				.replace(
					"#include <common>",
					"#include <common>\nuniform sampler2D colourMap;\nuniform float low, scale;\nuniform bool isMapped;\n" +
						"varying float vValue;",
				)
				.replace(
					"#include <color_fragment>",
					"#include <color_fragment>\nif (isMapped && vValue > -1e20) diffuseColor.rgb = texture2D(colourMap, " +
						"vec2(mix(0.5, 255.5, clamp((vValue - low) * scale, 0.0, 1.0)) / 256.0, 0.5)).rgb;",
				);
		};
		return material;
	}
}
