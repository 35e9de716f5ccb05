// The page in headless Chromium, as ./dev test runs it: JOUNCE is the command, CHROMIUM the browser.
import { defineConfig } from "@playwright/test";

export default defineConfig({
	testDir: "test",
	outputDir: process.env.JOUNCE_TEST_OUT ?? "../build/page_test",
	workers: 1, // software rendering takes all processors by itself
	timeout: 180_000, // of a busy machine; alone it takes seconds
	expect: { timeout: 20_000 },
	reporter: "list",
	use: {
		viewport: { width: 1000, height: 640 },
		colorScheme: "light",
		launchOptions: {
			executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
			args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
		},
	},
});
