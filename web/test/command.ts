// Recordings for the tests, and the server.
import { execFileSync, spawn, type ChildProcess } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const command = process.env.JOUNCE ?? join(import.meta.dirname ?? __dirname, "../../build/release/jounce");

const scene = `name: small
description: a soft bar that is held at one end
duration: 0.5 s
bodies:
  - name: bar
    shape: {type: box, size: [0.2, 0.2, 1], cells: [2, 2, 10]}
    material: {law: stable_neo_hookean, density: 1000, young: 1e5, poisson: 0.4}
    fix: [{where: {face: z-}}]
integrator: {method: sdirk2}
step: {controller: fixed, dt: 10 ms}
probes: [{name: tip, at: [0.1, 0.1, 1]}]
record: {interval: 1/30 s, plots: no}
`;

export class Workplace {
	readonly folder = mkdtempSync(join(tmpdir(), "jounce_page_"));
	private servers: ChildProcess[] = [];

	constructor() {
		writeFileSync(join(this.folder, "small.yaml"), scene);
		this.jounce("run", "small.yaml", "-o", "one", "-q");
		const other = ["--set", "integrator.method=backward_euler", "--set", "record.interval=20ms"];
		this.jounce("run", "small.yaml", "-o", "two", "-q", ...other);
		this.jounce("run", "small.yaml", "-o", "upright", "-q", "--set", "gravity=[0, 0, -9.81]");
		mkdirSync(join(this.folder, "half"));
		mkdirSync(join(this.folder, "foreign"));
		const whole = readFileSync(join(this.folder, "one/run.h5"));
		writeFileSync(join(this.folder, "half/run.h5"), whole.subarray(0, whole.length / 2));
		writeFileSync(join(this.folder, "foreign/run.h5"), "these are no data\n");
	}

	jounce(...words: string[]): string {
		return execFileSync(command, words, { cwd: this.folder, encoding: "utf8" });
	}

	// Start a server; its address.
	view(...words: string[]): Promise<string> {
		const server = spawn(command, ["view", "--no-open", ...words], { cwd: this.folder });
		this.servers.push(server);
		return new Promise((resolve, reject) => {
			let text = "";
			server.stdout.on("data", (part) => {
				text += part;
				const address = /http:\S+/.exec(text);
				if (address) resolve(address[0]);
			});
			server.on("exit", () => reject(new Error(`jounce view has ended: ${text}`)));
		});
	}

	// A server that is asked to end completes the files of its run first.
	async close() {
		const running = this.servers.filter((server) => server.exitCode === null);
		const ends = running.map((server) => new Promise((resolve) => server.once("exit", resolve)));
		for (const server of running) server.kill("SIGINT");
		await Promise.all(ends);
		rmSync(this.folder, { recursive: true, force: true });
	}
}
