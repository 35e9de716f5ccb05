// Text of scene files: parsing, overrides, keys, checks of names. Nothing is built. Behind the first zero byte, words up to
// the next newline or zero are overrides, as --set gives them.
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"
#include "support/fuzz.h"

enum { MOST_SETS = 8, SET_BYTES = 200 };

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	char words[MOST_SETS][SET_BYTES];
	const char* sets[MOST_SETS];
	int set_count = 0;
	const uint8_t* end = size > 0 ? memchr(data, '\0', size) : NULL;
	FuzzBytes rest = {end, end != NULL ? (size_t)(data + size - end) : 0};
	fuzz_byte(&rest);
	for (; rest.left > 0 && set_count < MOST_SETS; ++set_count) {
		fuzz_word(&rest, SET_BYTES, words[set_count]);
		sets[set_count] = words[set_count];
	}
	char* text = fuzz_text(data, end != NULL ? (size_t)(end - data) : size);
	JnScene* scene = NULL;
	fuzz_listen();
	const JnStatus status = jn_scene_parse("scene.yaml", text, set_count, sets, &scene);
	fuzz_judge(status);
	if ((status == JN_OK) != (scene != NULL)) abort();
	jn_scene_destroy(scene);
	free(text);
	return 0;
}
