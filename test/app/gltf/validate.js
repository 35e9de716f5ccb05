// Khronos' validator on glTF files: prints what it finds, and fails when that is an error or a warning.
import { readFileSync } from "node:fs";
import validator from "gltf-validator";

let count = 0;
for (const path of process.argv.slice(2)) {
	const report = await validator.validateBytes(new Uint8Array(readFileSync(path)), { maxIssues: 20 });
	const { numErrors, numWarnings, messages } = report.issues;
	count += numErrors + numWarnings;
	for (const message of messages) console.error(`${path}: ${message.code} ${message.pointer}: ${message.message}`);
	const { totalVertexCount, animationCount, hasMorphTargets } = report.info;
	console.log(`${path}: ${numErrors} errors, ${numWarnings} warnings; ${totalVertexCount} vertices, ` +
		`${animationCount} animations, morph targets: ${hasMorphTargets}`);
}
process.exit(count > 0 ? 1 : 0);
