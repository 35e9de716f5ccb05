// What the page costs in headless Chromium with software rendering: how soon a recording is shown, how many pictures a
// second it plays, what a picture takes of the processors, how much memory the browser has.
//
//	node measure.mjs DIR [--seconds 10] [--size 1280x720] [--field stress] [--no-panel] [--scrub] [--profile FILE.json]
//
// --scrub runs through all frames once, as a hand on the slider does, so that the page keeps as many as it ever does. JOUNCE is
// the command, CHROMIUM the browser. The profile is one of the page's own processor time, for DevTools.
import { spawn } from "node:child_process";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { chromium } from "@playwright/test";
import config from "./playwright.config.js";

const { values: options, positionals } = parseArgs({
	allowPositionals: true,
	options: {
		seconds: { type: "string", default: "10" },
		size: { type: "string", default: "1280x720" },
		field: { type: "string", default: "" },
		"no-panel": { type: "boolean", default: false },
		scrub: { type: "boolean", default: false },
		profile: { type: "string" },
	},
});
const folder = positionals[0];
if (!folder) throw new Error("give the folder of a recording");
const [width, height] = options.size.split("x").map(Number);
const command = process.env.JOUNCE ?? join(import.meta.dirname, "../build/release/jounce");
const TICKS = 100; // of /proc a second
const WARM_UP = 2000; // [ms], in which the page finds its quality

// The server and its address.
function serve() {
	const server = spawn(command, ["view", "--no-open", folder]);
	return new Promise((resolve, reject) => {
		let text = "";
		server.stdout.on("data", (part) => {
			text += part;
			const address = /http:\S+/.exec(text);
			if (address) resolve({ server, address: address[0] });
		});
		server.on("exit", () => reject(new Error(`jounce view has ended: ${text}`)));
	});
}

// Of the processes of a browser: proportional memory [MB], and processor time [s] by kind.
async function weigh(devtools) {
	const { processInfo } = await devtools.send("SystemInfo.getProcessInfo");
	let memory = 0;
	const seconds = {};
	for (const { id, type } of processInfo) {
		try {
			memory += Number(/^Pss:\s+(\d+)/m.exec(readFileSync(`/proc/${id}/smaps_rollup`, "utf8"))[1]) / 1000;
			const words = readFileSync(`/proc/${id}/stat`, "utf8").replace(/^.*\) /, "").split(" ");
			seconds[type] = (seconds[type] ?? 0) + (Number(words[11]) + Number(words[12])) / TICKS;
		} catch {
			// it has ended meanwhile
		}
	}
	return { memory, seconds };
}

const shown = (page) => page.evaluate(() => window.jounce.cost());
const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
const say = (name, value) => console.log(`${name.padEnd(34)} ${value}`);

async function measureOpening(page, address) {
	const start = performance.now();
	await page.goto(address + (options.field ? `?field=${options.field}` : ""));
	await page.waitForFunction(() => window.jounce);
	say("opened in [s]", ((performance.now() - start) / 1000).toFixed(2));
}

async function scrub(page) {
	const count = await page.evaluate(() => window.jounce.runs[0].times.length);
	const at = performance.now();
	for (let first = 0; first < count; first += 40)
		await page.evaluate(([from, to]) => {
			const wishes = Array.from({ length: to - from }, (_, i) => window.jounce.frame(from + i));
			return Promise.all(wishes).then(() => {});
		}, [first, Math.min(count, first + 40)]);
	await page.evaluate(() => window.jounce.picture().length); // until all is drawn
	say("frames looked through a second", ((1000 * count) / (performance.now() - at)).toFixed(0));
}

async function measurePlaying(page, devtools) {
	if (options["no-panel"]) await page.keyboard.press("p");
	await page.keyboard.press("Space");
	await wait(WARM_UP);
	const before = { ...(await shown(page)), ...(await weigh(devtools)), at: performance.now() };
	let most = before.memory;
	for (const end = before.at + 1000 * Number(options.seconds); performance.now() < end; ) {
		await wait(500);
		most = Math.max(most, (await weigh(devtools)).memory);
	}
	const after = { ...(await shown(page)), ...(await weigh(devtools)), at: performance.now() };
	await page.keyboard.press("Space");
	const seconds = (after.at - before.at) / 1000;
	const pictures = after.pictures - before.pictures;
	say("pictures a second", (pictures / seconds).toFixed(1));
	say("pixels of a picture", after.pixels.join("x"));
	for (const [type, spent] of Object.entries(after.seconds))
		if (spent > before.seconds[type])
			say(`${type}: processor [ms/picture]`, ((1000 * (spent - before.seconds[type])) / pictures).toFixed(1));
	say("memory of the browser, most [MB]", most.toFixed(0));
}

const { server, address } = await serve();
const browser = await chromium.launch(config.use.launchOptions);
try {
	say("recording [MB]", (statSync(join(folder, "run.h5")).size / 1e6).toFixed(0));
	const page = await browser.newPage({ viewport: { width, height } });
	const devtools = await browser.newBrowserCDPSession();
	const tracer = await page.context().newCDPSession(page);
	await measureOpening(page, address);
	if (options.scrub) await scrub(page);
	if (options.profile) await tracer.send("Profiler.enable");
	if (options.profile) await tracer.send("Profiler.start");
	await measurePlaying(page, devtools);
	if (options.profile) writeFileSync(options.profile, JSON.stringify((await tracer.send("Profiler.stop")).profile));
	const heap = await tracer.send("Runtime.getHeapUsage");
	say("heap of the page [MB]", `${(heap.usedSize / 1e6).toFixed(0)}, arrays ${((heap.backingStorageSize ?? 0) / 1e6).toFixed(0)}`);
	const status = readFileSync(`/proc/${server.pid}/status`, "utf8");
	say("memory of the command, most [MB]", (Number(/VmHWM:\s+(\d+)/.exec(status)[1]) / 1000).toFixed(0));
} finally {
	await browser.close();
	server.removeAllListeners("exit");
	server.kill("SIGINT");
}
