// One file of HTML with everything in it, to be put into the command.
import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

export default defineConfig({
	plugins: [viteSingleFile({ removeViteModuleLoader: true })],
	build: { target: "es2022", chunkSizeWarningLimit: 2000 },
	server: { proxy: { "/api": "http://127.0.0.1:8000" } }, // `jounce view DIR --port 8000`, and `npm run dev`
});
