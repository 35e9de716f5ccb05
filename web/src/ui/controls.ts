// The bar under the picture: play, scrub, speed, colours.
import { speedList } from "../playback";
import { mapNames } from "../scene/colours";
import { format, h } from "./dom";
import { icon } from "./icons";
import type { Page } from "./page";

const button = (name: string, label: string, press: () => void) =>
	h("button", { type: "button", className: "icon", title: label, "aria-label": label, onclick: press }, icon(name));

function makeTransport(page: Page) {
	const { playback } = page.viewer;
	const play = button("play", "Play", () => playback.toggle());
	const loop = button("loop", "Loop", () => page.toggleLoop());
	const element = h(
		"div",
		{ className: "transport", role: "group", "aria-label": "Playing" },
		button("first", "First frame", () => playback.show(-Infinity)),
		button("back", "Previous frame", () => playback.step(-1)),
		play,
		button("next", "Next frame", () => playback.step(1)),
		button("last", "Last frame", () => playback.show(Infinity)),
		loop,
	);
	const update = () => {
		const name = playback.isPlaying ? "pause" : "play";
		if (play.dataset.icon !== name) {
			play.dataset.icon = name;
			play.replaceChildren(icon(name));
			play.title = playback.isPlaying ? "Pause" : "Play";
			play.setAttribute("aria-label", play.title);
		}
		loop.setAttribute("aria-pressed", String(playback.isLooping));
	};
	return { element, update };
}

function makeScrubber(page: Page) {
	const { playback, views } = page.viewer;
	const slider = h("input", { type: "range", className: "time", step: "any", "aria-label": "Time" });
	const text = h("span", { className: "clock" });
	slider.addEventListener("input", () => {
		const wanted = Number(slider.value); // pausing puts the slider back to the time that is shown
		playback.pause();
		page.viewer.stage.hurry();
		playback.show(wanted);
	});
	const update = () => {
		const first = views[0];
		slider.min = String(playback.start);
		slider.max = String(playback.end);
		slider.value = String(playback.time);
		const share = (playback.time - playback.start) / (playback.end - playback.start || 1);
		slider.style.setProperty("--share", `${100 * share}%`);
		const shown = format(playback.time, 4);
		text.textContent = `${shown} / ${format(playback.end, 4)} s`;
		text.title = `frame ${first.run.frameAt(playback.time) + 1} of ${first.run.frameCount}`;
		slider.setAttribute("aria-valuetext", `${shown} s, ${text.title}`);
	};
	return { element: h("div", { className: "scrubber" }, slider, text), update };
}

function makeSpeed(page: Page) {
	const { playback } = page.viewer;
	const select = h(
		"select",
		{ "aria-label": "Speed", title: "Speed: simulated seconds a second" },
		...speedList.map((speed) => h("option", { value: String(speed) }, `${speed}×`)),
	);
	select.addEventListener("change", () => (playback.speed = Number(select.value)));
	return { element: select, update: () => void (select.value = String(playback.speed)) };
}

function makeColours(page: Page) {
	const { colouring } = page.viewer;
	const field = h("select", { id: "colour-by" });
	const map = h(
		"select",
		{ "aria-label": "Colour map", title: "Colour map" },
		...mapNames.map((name) => h("option", { value: name }, name)),
	);
	field.addEventListener("change", () => page.colourBy(field.value));
	map.addEventListener("change", () => page.setMap(map.value));
	const update = () => {
		const option = (name: string, label: string, absent?: string) =>
			h("option", { value: name, disabled: absent !== undefined, title: absent ?? "" }, label);
		field.replaceChildren(
			option("", "bodies"),
			...colouring.choices.map(({ name, label, absent }) => option(name, absent ? `${label} – ${absent}` : label, absent)),
		);
		field.value = colouring.field;
		map.value = colouring.map;
		map.hidden = colouring.field === "";
	};
	return { element: h("div", { className: "colours" }, h("label", { for: "colour-by" }, "Colour by"), field, map), update };
}

export function makeControls(page: Page) {
	const transport = makeTransport(page);
	const scrubber = makeScrubber(page);
	const speed = makeSpeed(page);
	const colours = makeColours(page);
	const fit = button("fit", "See everything", () => page.viewer.stage.fit());
	const element = h(
		"div",
		{ className: "controls", role: "toolbar", "aria-label": "Playback and colours" },
		h("div", { className: "row" }, transport.element, scrubber.element, speed.element),
		h("div", { className: "row" }, colours.element, h("span", { className: "space" }), fit),
	);
	return {
		element,
		updateTime: () => {
			transport.update();
			scrubber.update();
			speed.update();
		},
		updateColours: colours.update,
	};
}

export { button };
