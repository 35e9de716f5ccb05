// The viewer as people and programs meet it.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { expect, test, type Page } from "@playwright/test";
import { uprightOf, type Point } from "../src/data/upright";
import { Workplace } from "./command";

let place: Workplace;
let both: string; // address of two runs side by side

test.beforeAll(async () => {
	place = new Workplace();
	both = await place.view("one", "two");
});
test.afterAll(() => place.close());

let complaints: string[] = [];

test.beforeEach(({ page }) => {
	complaints = [];
	page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
	page.on("pageerror", (error) => complaints.push(String(error)));
});
test.afterEach(() => expect(complaints, "what the page complains about in the console").toEqual([]));

async function open(page: Page, address: string) {
	await page.goto(address);
	await page.waitForFunction(() => (window as any).jounce);
}

const shown = (page: Page) => page.evaluate(() => (window as any).jounce.shown());
const picture = (page: Page): Promise<string> => page.evaluate(() => (window as any).jounce.picture());

// How many colours the picture has, of some thousand of its pixels.
const countColours = (page: Page): Promise<number> =>
	page.evaluate(async () => {
		const image = new Image();
		image.src = (window as any).jounce.picture();
		await image.decode();
		const canvas = document.createElement("canvas");
		[canvas.width, canvas.height] = [80, 60];
		const context = canvas.getContext("2d")!;
		context.drawImage(image, 0, 0, canvas.width, canvas.height);
		const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
		return new Set(Array.from({ length: data.length / 4 }, (_, i) => data.slice(4 * i, 4 * i + 3).join())).size;
	});

test("shows a picture that is not blank", async ({ page }) => {
	await open(page, both);
	await expect(page).toHaveTitle("small – jounce");
	expect(await countColours(page)).toBeGreaterThan(100);
	await expect(page.getByText("sdirk2, 0 s")).toBeVisible();
	await expect(page.locator(".plots figure")).toHaveCount(5); // energy, error, step, Newton, probe
});

test("scrubbing and stepping change the picture", async ({ page }) => {
	await open(page, both);
	const start = await picture(page);
	await page.getByRole("slider", { name: "Time" }).fill("0.3");
	await expect.poll(async () => (await shown(page)).frames).toEqual([9, 15]);
	const later = await picture(page);
	expect(later).not.toBe(start);
	await page.getByRole("button", { name: "Next frame" }).click();
	await expect.poll(async () => (await shown(page)).time).toBeCloseTo(0.32, 6); // the second run's next
	expect(await picture(page)).not.toBe(later);
	await page.getByRole("button", { name: "First frame" }).click();
	await expect.poll(() => picture(page)).toBe(start);
});

test("colour-by changes the legend and the picture", async ({ page }) => {
	await open(page, both);
	await page.evaluate(() => (window as any).jounce.time(0.3));
	const plain = await picture(page);
	const legend = page.locator(".legend");
	await expect(legend).toBeHidden();
	const seen = new Set([plain]);
	for (const [field, title] of [
		["displacement", "Displacement [m]"],
		["speed", "Speed [m/s]"],
		["strain_energy_density", "Strain energy density [J/m³]"],
		["stress", "Stress (von Mises) [Pa]"],
	]) {
		await page.getByLabel("Colour by").selectOption(field);
		await expect(legend.locator(".legend-title")).toHaveText(title);
		await expect.poll(async () => (await shown(page)).field).toBe(field);
		await expect.poll(async () => seen.has(await picture(page))).toBe(false);
		seen.add(await picture(page));
	}
	const ticks = await legend.locator(".legend-ticks span").allTextContents();
	expect(Number(ticks[2])).toBeGreaterThan(Number(ticks[0]));
	await page.getByLabel("Colour map").selectOption("magma");
	expect(seen.has(await picture(page))).toBe(false);
});

test("two runs stay in step while they play", async ({ page }) => {
	await open(page, both);
	const times = await page.evaluate(() => (window as any).jounce.runs.map((run: { times: number[] }) => run.times));
	await page.keyboard.press("Space");
	const seen = new Set<number>();
	for (let look = 0; look < 25; ++look) {
		const { time, frames } = await shown(page);
		const at = frames.map((frame: number, run: number) => times[run][frame]);
		const before = times.map((list: number[]) => list.filter((t) => t <= time + 1e-9).at(-1));
		// What is drawn is of one moment: that of the clock, or of its last picture.
		expect(Math.abs(at[0] - at[1])).toBeLessThanOrEqual(1 / 30 + 1e-9);
		expect(Math.abs(at[0] - before[0])).toBeLessThan(0.26);
		seen.add(frames[0]);
		await page.waitForTimeout(40);
	}
	expect(seen.size).toBeGreaterThan(2);
	await page.keyboard.press("Space");
	await expect(page.getByRole("button", { name: "Play", exact: true })).toBeVisible();
});

test("a saved page works from the file system", async ({ page }) => {
	place.jounce("view", "one", "two", "--save", "saved.html");
	await open(page, `file://${join(place.folder, "saved.html")}`);
	expect(await countColours(page)).toBeGreaterThan(100);
	const start = await picture(page);
	await page.evaluate(() => (window as any).jounce.time(0.3));
	expect(await picture(page)).not.toBe(start);
	for (const field of ["speed", "stress"]) {
		await page.getByLabel("Colour by").selectOption(field);
		await expect.poll(async () => (await shown(page)).field).toBe(field);
	}
	await expect(page.locator(".plots figure")).toHaveCount(5);
});

test("files that are no recordings get a message", async ({ page }) => {
	await page.goto(await place.view("half", "foreign", "nowhere"));
	const messages = page.getByRole("alert");
	await expect(messages).toHaveCount(3);
	await expect(messages.nth(0)).toContainText("half/run.h5: is cut off, damaged, or no recording");
	await expect(messages.nth(1)).toContainText("foreign/run.h5: is no HDF5 file");
	await expect(messages.nth(2)).toContainText("nowhere/run.h5: there is no such file");
});

test("a file that is no recording does not hide one that is", async ({ page }) => {
	await open(page, await place.view("half", "one"));
	await expect(page.getByRole("alert")).toContainText("half/run.h5: is cut off");
	expect(await countColours(page)).toBeGreaterThan(100);
});

test("keys do what the help page says", async ({ page }) => {
	await open(page, both);
	await page.keyboard.press("?");
	const help = page.getByRole("dialog", { name: "Keys" });
	await expect(help).toBeVisible();
	await page.keyboard.press("Escape");
	await expect(help).toBeHidden();
	await page.keyboard.press("End");
	await expect.poll(async () => (await shown(page)).frames).toEqual([15, 25]);
	await page.keyboard.press("ArrowLeft");
	await expect.poll(async () => (await shown(page)).frames).toEqual([14, 24]);
	await page.keyboard.press("c");
	await expect(page.locator(".legend-title")).toHaveText("Displacement [m]");
	await page.keyboard.press("l");
	await expect(page.getByRole("button", { name: "Loop" })).toHaveAttribute("aria-pressed", "false");
	const before = await picture(page);
	await page.keyboard.press("a");
	expect(await picture(page)).not.toBe(before);
	await page.keyboard.press("f");
	await expect.poll(() => picture(page)).toBe(before);
	await page.keyboard.press("p");
	await expect(page.getByRole("complementary")).toBeHidden();
	await page.keyboard.press("t");
	await expect(page.locator("html")).toHaveAttribute("data-theme", "dark");
});

test("a click into a plot goes to its time", async ({ page }) => {
	await open(page, both);
	const area = page.locator(".u-over").first();
	const box = (await area.boundingBox())!;
	await area.click({ position: { x: box.width / 2, y: box.height / 2 } });
	await expect.poll(async () => (await shown(page)).time).toBeGreaterThan(0.15);
	expect((await shown(page)).time).toBeLessThan(0.35);
});

test("statistics and scene are there", async ({ page }) => {
	await open(page, both);
	await page.getByRole("tab", { name: "Statistics" }).click();
	await expect(page.getByRole("row", { name: "Steps 50 50" })).toBeVisible();
	await page.getByRole("tab", { name: "Scene" }).click();
	await expect(page.getByText("--set integrator.method=backward_euler")).toBeVisible();
});

test("has nothing serious to say for axe, in light, dark and on a phone", async ({ page }) => {
	const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
	const check = async () => {
		const found = await page.evaluate(async () => (await (window as any).axe.run()).violations);
		const serious = found.filter(({ impact }: { impact: string }) => ["serious", "critical"].includes(impact));
		expect(serious.map(({ id, nodes }: any) => `${id}: ${nodes[0].html}`)).toEqual([]);
	};
	await open(page, `${both}?field=speed`);
	await page.addScriptTag({ content: axe });
	for (const tab of ["Statistics", "Scene", "Plots"]) {
		await page.getByRole("tab", { name: tab }).click();
		await check();
	}
	await page.keyboard.press("t");
	await check();
	await page.setViewportSize({ width: 390, height: 800 });
	await check();
});

test("fits a phone", async ({ page }) => {
	await page.setViewportSize({ width: 360, height: 740 });
	await open(page, both);
	expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(360);
	await expect(page.getByRole("button", { name: "Play", exact: true })).toBeInViewport();
	await expect(page.getByRole("slider", { name: "Time" })).toBeInViewport();
});

test("frames of a run appear as they are written", async ({ page }) => {
	const slow = ["--set", "duration=60s", "--set", "step.dt=2ms", "--threads", "1"];
	await open(page, await place.view("small.yaml", "-o", "live", ...slow));
	await expect(page.getByRole("status")).toHaveText("running");
	const count = () => page.evaluate(() => (window as any).jounce.runs[0].times.length);
	const first = await count();
	await expect.poll(count, { timeout: 20_000 }).toBeGreaterThan(first);
});

// Width and height of what has the colour of the first body.
const measureBody = (page: Page): Promise<[number, number]> =>
	page.evaluate(async () => {
		const image = new Image();
		image.src = (window as any).jounce.picture();
		await image.decode();
		const canvas = document.createElement("canvas");
		[canvas.width, canvas.height] = [image.width, image.height];
		const context = canvas.getContext("2d")!;
		context.drawImage(image, 0, 0);
		const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
		const isBlue = (at: number) => data[at + 2] > data[at] + 50;
		const places = Array.from({ length: data.length / 4 }, (_, i) => i).filter((i) => isBlue(4 * i));
		const [columns, rows] = [places.map((i) => i % canvas.width), places.map((i) => Math.floor(i / canvas.width))];
		const extent = (list: number[]) => list.reduce((a, b) => Math.max(a, b)) - list.reduce((a, b) => Math.min(a, b));
		return [extent(columns), extent(rows)];
	});

test("up is against gravity, along any axis, by a rotation", () => {
	for (const axis of [0, 1, 2])
		for (const sign of [1, -1]) {
			const gravity = [0.1, 0.1, 0.1].map((g, i) => (i === axis ? 9.81 * sign : g)) as Point;
			const turn = uprightOf(gravity);
			expect(turn([...gravity] as Point)[1]).toBe(-9.81);
			const [[a, b, c], [d, e, f], [g, h, i]] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((unit) => turn(unit as Point));
			expect(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)).toBe(1); // determinant
		}
	expect(uprightOf([0, 0, 0])([1, 2, 3])).toEqual([1, 2, 3]);
});

test("a bar along z stands when gravity is along z", async ({ page }) => {
	await open(page, `${await place.view("upright")}?render&camera=30,10`);
	const [width, height] = await measureBody(page);
	expect(height).toBeGreaterThan(2 * width); // 1 m high, and 0.2 m wide, on its diagonal 0.28 m
});

test("gives programs bare pictures of a size and a frame", async ({ page }) => {
	await page.setViewportSize({ width: 480, height: 270 });
	await open(page, `${both}?render&size=480x270&frame=3&field=speed&range=0,2&camera=20,10,1.5`);
	expect((await shown(page)).frames[0]).toBe(3);
	await expect(page.getByRole("button")).toHaveCount(0);
	await expect(page.locator(".legend-ticks span").last()).toHaveText("2");
	expect(await page.locator("canvas").boundingBox()).toMatchObject({ x: 0, y: 0, width: 480, height: 270 });
	const one = await picture(page);
	await page.evaluate(() => (window as any).jounce.frame(5));
	expect((await shown(page)).frames[0]).toBe(5);
	expect(await picture(page)).not.toBe(one);
	await page.evaluate(() => (window as any).jounce.frame(3));
	expect(await picture(page)).toBe(one); // the same frame is the same picture, bit for bit
});
