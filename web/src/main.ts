// The page: opens the runs, and shows them.
import { SavedSource, isSaved } from "./data/saved";
import { ServerSource } from "./data/source";
import { makeHook } from "./hook";
import { follow } from "./live";
import { readOptions } from "./options";
import { showRender } from "./render";
import { shoot } from "./shoot";
import { h } from "./ui/dom";
import { Page } from "./ui/page";
import { Viewer } from "./viewer";
import "./style.css";

const app = document.getElementById("app")!;

function tell(words: string[]) {
	const messages = words.map((text) => h("p", { className: "message", role: "alert" }, text));
	app.replaceChildren(h("main", { className: "only-messages" }, h("h1", {}, "jounce"), ...messages));
}

// A run that has just been started has no recording yet.
async function open(): Promise<Viewer | null> {
	const options = readOptions(location.search);
	const source = isSaved() ? new SavedSource() : new ServerSource();
	for (;;) {
		const entries = await source.runs();
		const isAwaited = entries.some((entry) => entry.error === "");
		if (!isAwaited && entries.every((entry) => entry.error !== undefined)) {
			tell(entries.map((entry) => entry.error!));
			return null;
		}
		if (!isAwaited) return Viewer.open(source, options);
		app.replaceChildren(h("p", { className: "waiting", role: "status" }, "The simulation is being set up …"));
		await new Promise((resolve) => setTimeout(resolve, 400));
	}
}

async function main() {
	const { shootKey } = readOptions(location.search);
	if (shootKey !== null) return shoot(shootKey, open);
	const viewer = await open();
	if (!viewer) return;
	app.replaceChildren();
	if (viewer.options.isRender) {
		showRender(app, viewer);
	} else {
		const page = new Page(app, viewer);
		if (!isSaved()) follow(viewer, page); // a saved page does not change
	}
	await viewer.start();
	Object.assign(window, { jounce: makeHook(viewer) });
}

main().catch((error) => tell([`The page cannot show this: ${error.message}`]));
