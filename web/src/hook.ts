// What programs may use: window.jounce, there once the page shows its first picture.
import type { Viewer } from "./viewer";

export function makeHook(viewer: Viewer) {
	const { playback, views, stage, colouring } = viewer;
	return {
		runs: views.map(({ run }) => ({ name: run.name, folder: run.folder, times: run.times })),
		// Show a frame of the first run, and the others at its time; resolves when it is drawn.
		frame: (number: number) => playback.show(views[0].run.times[number] ?? Infinity),
		// Show a time [s].
		time: (time: number) => playback.show(time),
		// Turn the camera: azimuth and elevation [degrees], zoom 1 shows all.
		camera: (azimuth: number, elevation: number, zoom = 1) => stage.fit({ azimuth, elevation, zoom }),
		// Colour by a field ("" by none), over a range or that of the run.
		async colour(field: string, range: [number, number] | null = null) {
			await colouring.choose(field, range);
			await playback.refresh();
		},
		// What is shown now.
		shown: () => ({ time: playback.time, frames: views.map((view) => view.frame), field: colouring.field }),
		// Pictures that were drawn so far, and the pixels of the last one; for measure.mjs.
		cost: () => ({ pictures: stage.drawnCount, pixels: [stage.canvas.width, stage.canvas.height] }),
		// The picture as a data URL; drawn anew, since browsers forget what they have shown.
		picture() {
			stage.drawBest();
			return stage.canvas.toDataURL("image/png");
		},
	};
}
