// Which numbers colour the bodies, by which map, over which range: the same for all runs, so that they can be compared.
import { Absent } from "./data/source";
import { isAbsent } from "./data/run";
import { mapNames } from "./scene/colours";
import { sampleFrames, type RunView } from "./scene/run_view";
import type { Stage } from "./scene/stage";

export type Choice = { name: string; label: string; unit: string; absent?: string };

const labels: Record<string, string> = {
	displacement: "Displacement",
	speed: "Speed",
	strain_energy_density: "Strain energy density",
	stress: "Stress (von Mises)",
	damage: "Damage",
	contact_force: "Contact force",
	gap: "Gap",
	fragment: "Fragment",
};

export class Colouring {
	choices: Choice[] = [];
	field = "";
	map = mapNames[0];
	range: [number, number] = [0, 1];
	isFixed = false; // the range was given by the user
	onChange: () => void = () => {};

	constructor(private stage: Stage) {}

	// The fields of all runs; one that some run lacks stays, since the others have it.
	list() {
		const found = new Map<string, Choice>();
		found.set("displacement", { name: "displacement", label: labels.displacement, unit: "m" });
		for (const view of this.stage.views)
			for (const field of view.run.fields) {
				const known = found.get(field.name);
				if (!known || known.absent) found.set(field.name, { ...field, label: labels[field.name] ?? field.name });
			}
		this.choices = [...found.values()];
	}

	get choice(): Choice | undefined {
		return this.choices.find((choice) => choice.name === this.field);
	}

	async choose(name: string, range: [number, number] | null = null) {
		const choice = this.choices.find((known) => known.name === name && known.absent === undefined);
		this.field = choice ? name : "";
		this.isFixed = range !== null;
		try {
			if (choice) this.range = range ?? (await this.measure(name));
		} catch (error) {
			if (!(error instanceof Absent)) throw error;
			choice!.absent = error.message;
			this.field = "";
		}
		this.apply();
	}

	// A frame that was not there when the range was measured.
	async grow(view: RunView, frame: number) {
		if (this.field === "" || this.isFixed || !has(view, this.field)) return;
		const values = (await view.run.field(this.field, frame)).filter((value) => !isAbsent(value));
		const low = values.reduce((least, value) => Math.min(least, value), this.range[0]);
		const high = values.reduce((most, value) => Math.max(most, value), this.range[1]);
		if (low === this.range[0] && high === this.range[1]) return;
		this.range = [low, high];
		this.apply();
	}

	setMap(name: string) {
		if (mapNames.includes(name)) this.map = name;
		this.apply();
	}

	setRange(low: number, high: number) {
		this.isFixed = true;
		this.range = [low, high];
		this.apply();
	}

	apply() {
		for (const view of this.stage.views) {
			const isMapped = this.field !== "" && has(view, this.field);
			view.field = isMapped ? this.field : "";
			view.paint.isMapped = isMapped;
			view.paint.setMap(this.map);
			view.paint.setRange(...this.range);
		}
		this.onChange();
	}

	// Least and largest number in some frames of all runs.
	private async measure(name: string): Promise<[number, number]> {
		let low = Infinity;
		let high = -Infinity;
		const all = this.stage.views.filter((view) => has(view, name));
		const wishes = all.flatMap((view) => sampleFrames(view.run.frameCount).map((frame) => view.run.field(name, frame)));
		for (const values of await Promise.all(wishes))
			for (const value of values) {
				if (isAbsent(value)) continue;
				if (value < low) low = value;
				if (value > high) high = value;
			}
		return low < high ? [low, high] : Number.isFinite(low) ? [low, low + (Math.abs(low) || 1)] : [0, 1];
	}
}

function has(view: RunView, name: string): boolean {
	return name === "displacement" || view.run.fields.some((field) => field.name === name && !field.absent);
}
