// Runs in progress: their new frames are looked for once a second, and now and then where none has come for long.
import type { RunView } from "./scene/run_view";
import type { Page } from "./ui/page";
import type { Viewer } from "./viewer";

const PAUSE = 1000; // [ms]
const LONG_PAUSE = 10_000;

const isOpen = (view: RunView) => view.run.state.outcome === "running";

export function follow(viewer: Viewer, page: Page) {
	const { views, playback, colouring } = viewer;

	const lookAt = async (view: RunView): Promise<boolean> => {
		const isNew = await view.run.refresh();
		if (!isNew) return false;
		await view.grow(view.run.frameCount - 1);
		await colouring.grow(view, view.run.frameCount - 1);
		return true;
	};

	const look = async () => {
		const wasAtEnd = playback.time >= playback.end - 1e-9;
		const found = await Promise.all(views.filter(isOpen).map((view) => lookAt(view).catch(() => false)));
		if (found.some(Boolean) || !views.some(isOpen)) page.updateRuns();
		if (found.some(Boolean) && wasAtEnd && !playback.isPlaying) await playback.show(playback.end);
		wait();
	};

	const wait = () => {
		if (views.some(isOpen)) setTimeout(look, views.some((view) => view.run.state.is_running) ? PAUSE : LONG_PAUSE);
	};

	wait();
}
