// What can be done, each with its keys: buttons, the keyboard and the help page are made from this one list.
import { speedList } from "../playback";
import type { Page } from "./page";

export type Command = { keys: string[]; shown: string; what: string; run: (page: Page) => void };

const speeds = speedList;

function changeSpeed(page: Page, direction: 1 | -1) {
	const { playback } = page.viewer;
	const nearest = speeds.reduce((best, speed, i) =>
		Math.abs(Math.log(speed / playback.speed)) < Math.abs(Math.log(speeds[best] / playback.speed)) ? i : best, 0);
	playback.speed = speeds[Math.min(speeds.length - 1, Math.max(0, nearest + direction))];
	playback.onChange();
}

function nextField(page: Page, direction: 1 | -1) {
	const { colouring } = page.viewer;
	const names = ["", ...colouring.choices.filter((choice) => !choice.absent).map((choice) => choice.name)];
	const at = names.indexOf(colouring.field) + direction + names.length;
	page.colourBy(names[at % names.length]);
}

export const commands: Command[] = [
	{ keys: [" ", "k"], shown: "Space", what: "play, pause", run: ({ viewer }) => viewer.playback.toggle() },
	{ keys: ["ArrowRight", "."], shown: "→", what: "next frame", run: ({ viewer }) => viewer.playback.step(1) },
	{ keys: ["ArrowLeft", ","], shown: "←", what: "previous frame", run: ({ viewer }) => viewer.playback.step(-1) },
	{ keys: ["Home"], shown: "Home", what: "first frame", run: ({ viewer }) => viewer.playback.show(-Infinity) },
	{ keys: ["End"], shown: "End", what: "last frame", run: ({ viewer }) => viewer.playback.show(Infinity) },
	{ keys: ["+", "="], shown: "+", what: "play faster", run: (page) => changeSpeed(page, 1) },
	{ keys: ["-"], shown: "−", what: "play slower", run: (page) => changeSpeed(page, -1) },
	{ keys: ["l"], shown: "L", what: "loop, or stop at the end", run: (page) => page.toggleLoop() },
	{ keys: ["f"], shown: "F", what: "see everything", run: ({ viewer }) => viewer.stage.fit() },
	{ keys: ["1"], shown: "1", what: "look from the front", run: (page) => page.look(0, 0) },
	{ keys: ["2"], shown: "2", what: "look from the side", run: (page) => page.look(90, 0) },
	{ keys: ["3"], shown: "3", what: "look down", run: (page) => page.look(0, 89.9) },
	{ keys: ["a"], shown: "A", what: "orbit left", run: ({ viewer }) => viewer.stage.orbit(-10, 0) },
	{ keys: ["d"], shown: "D", what: "orbit right", run: ({ viewer }) => viewer.stage.orbit(10, 0) },
	{ keys: ["w"], shown: "W", what: "orbit up", run: ({ viewer }) => viewer.stage.orbit(0, 10) },
	{ keys: ["s"], shown: "S", what: "orbit down", run: ({ viewer }) => viewer.stage.orbit(0, -10) },
	{ keys: ["e"], shown: "E", what: "closer", run: ({ viewer }) => viewer.stage.zoom(1.15) },
	{ keys: ["q"], shown: "Q", what: "farther", run: ({ viewer }) => viewer.stage.zoom(1 / 1.15) },
	{ keys: ["c"], shown: "C", what: "colour by the next field", run: (page) => nextField(page, 1) },
	{ keys: ["x"], shown: "X", what: "colour by the previous field", run: (page) => nextField(page, -1) },
	{ keys: ["m"], shown: "M", what: "next colour map", run: (page) => page.nextMap() },
	{ keys: ["t"], shown: "T", what: "dark, light", run: (page) => page.toggleTheme() },
	{ keys: ["p"], shown: "P", what: "show or hide plots and statistics", run: (page) => page.togglePanel() },
	{ keys: ["?", "h"], shown: "?", what: "this list", run: (page) => page.toggleHelp() },
];

const isWriting = (target: EventTarget | null) =>
	target instanceof HTMLElement && target.matches("select, textarea, input:not([type=range], [type=checkbox])");

// Space and Enter on a button press it, arrows in a list of tabs choose one.
const isPressing = (event: KeyboardEvent) =>
	event.target instanceof HTMLElement &&
	((event.key === " " && event.target.matches("button, summary, [type=checkbox]")) ||
		(event.key.startsWith("Arrow") && event.target.matches("[role=tab]")));

export function listenToKeys(page: Page) {
	addEventListener("keydown", (event) => {
		if (event.ctrlKey || event.metaKey || event.altKey || isWriting(event.target) || isPressing(event)) return;
		if (document.querySelector("dialog[open]") && event.key !== "?") return;
		const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
		const command = commands.find((known) => known.keys.includes(key));
		if (!command) return;
		event.preventDefault();
		command.run(page);
	});
}
