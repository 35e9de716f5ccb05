// The list of keys.
import { commands } from "./commands";
import { h } from "./dom";
import { icon } from "./icons";

export function makeHelp(): HTMLDialogElement {
	const rows = commands.map(({ shown, what }) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, shown)), h("td", {}, what)));
	const close = h("button", { type: "button", "aria-label": "Close" }, icon("close"));
	const dialog = h(
		"dialog",
		{ className: "help", "aria-labelledby": "help-title" },
		h("div", { className: "help-head" }, h("h2", { id: "help-title" }, "Keys"), close),
		h("table", {}, h("tbody", {}, ...rows)),
		h("p", {}, "Drag to turn, drag with the right button or two fingers to move, wheel or pinch to zoom. ",
			"Click into a plot to go to its time."),
	);
	close.addEventListener("click", () => dialog.close());
	dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
	return dialog;
}
