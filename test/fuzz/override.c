// Overrides, --set path=value, one a line, on a small scene; the keys are read after each that is accepted.
#include <stdlib.h>

#include "base/document.h"
#include "base/key.h"
#include "jounce/scene.h"
#include "support/fuzz.h"

static const char start[] = "bodies:\n"
							"  - name: a\n"
							"    shape: {type: box, size: [1, 1, 1], divisions: [2, 2, 2]}\n"
							"    fix: [{where: {box: {low: [0, 0, 0], high: [1, 1, 1]}}}]\n"
							"probes: [{name: p, at: [0, 0, 0]}]\n"
							"step: {dt: 1 ms}\n";

static JnStatus set(JnDocument* document, const char* assignment) {
	JN_TRY(jn_document_set(document, assignment));
	JnSceneDef def;
	return jn_keys_read(jn_scene_keys, document->root, "", document->arena, &def);
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	JnArena arena = {0};
	JnDocument document;
	FuzzBytes bytes = {data, size};
	if (jn_document_parse("scene.yaml", start, &arena, &document) != JN_OK) abort();
	for (int i = 0; bytes.left > 0 && i < 16; ++i) {
		char assignment[400];
		fuzz_word(&bytes, sizeof assignment, assignment);
		fuzz_listen();
		fuzz_judge(set(&document, assignment));
	}
	jn_arena_free(&arena);
	return 0;
}
