#include "view_code.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "base/log.h"

enum { CODES = 65535, HEAD_REALS = 2 };

JnStatus view_code_bytes(const void* bytes, size_t size, ViewBytes* out) {
	uLongf length = compressBound((uLong)size);
	*out = (ViewBytes){.data = malloc(length + 1)};
	if (out->data == NULL || compress2((Bytef*)out->data, &length, bytes, (uLong)size, Z_BEST_COMPRESSION) != Z_OK) {
		free(out->data);
		*out = (ViewBytes){0};
		return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room to compress %zu bytes", size);
	}
	out->size = length;
	return JN_OK;
}

// low and step of one column; step 0 when all of it is the same.
static void measure(const float* numbers, int count, int parts, float head[HEAD_REALS]) {
	float low = INFINITY, high = -INFINITY;
	for (int i = 0; i < count; ++i) {
		const float number = numbers[(ptrdiff_t)i * parts];
		if (number <= (float)VIEW_ABSENT) continue;
		low = fminf(low, number);
		high = fmaxf(high, number);
	}
	head[0] = low <= high ? low : 0;
	head[1] = low < high ? (high - low) / (CODES - 1) : 0;
}

static void encode(const float* numbers, int count, int parts, const float head[HEAD_REALS], unsigned char* low,
				   unsigned char* high) {
	unsigned before = 0;
	for (int i = 0; i < count; ++i) {
		const float number = numbers[(ptrdiff_t)i * parts];
		const bool is_absent = number <= (float)VIEW_ABSENT;
		const float place = head[1] > 0 ? roundf((number - head[0]) / head[1]) : 0;
		const unsigned code = is_absent ? 0 : 1 + (unsigned)fminf(fmaxf(place, 0), CODES - 1);
		const unsigned difference = (code - before) & 0xFFFF;
		low[i] = (unsigned char)(difference & 0xFF);
		high[i] = (unsigned char)(difference >> 8);
		before = code;
	}
}

JnStatus view_code_numbers(const float* numbers, int count, int parts, ViewBytes* out) {
	const size_t head_bytes = (size_t)parts * HEAD_REALS * sizeof(float), codes = (size_t)count * (size_t)parts;
	unsigned char* chunk = malloc(head_bytes + 2 * codes + 1);
	*out = (ViewBytes){0};
	if (chunk == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for %d numbers", count);
	unsigned char *low = chunk + head_bytes, *high = low + codes;
	for (int part = 0; part < parts; ++part) {
		float head[HEAD_REALS];
		measure(numbers + part, count, parts, head);
		memcpy(chunk + (size_t)part * sizeof head, head, sizeof head);
		encode(numbers + part, count, parts, head, low + (ptrdiff_t)part * count, high + (ptrdiff_t)part * count);
	}
	const JnStatus status = view_code_bytes(chunk, head_bytes + 2 * codes, out);
	free(chunk);
	return status;
}

void view_code_print(FILE* file, const ViewBytes* bytes) {
	static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	const unsigned char* data = (const unsigned char*)bytes->data;
	for (size_t i = 0; i < bytes->size; i += 3) {
		const size_t left = bytes->size - i;
		const unsigned second = left > 1 ? data[i + 1] : 0, third = left > 2 ? data[i + 2] : 0;
		const unsigned word = (unsigned)data[i] << 16 | second << 8 | third;
		const char quad[4] = {letters[word >> 18], letters[word >> 12 & 63], left > 1 ? letters[word >> 6 & 63] : '=',
							  left > 2 ? letters[word & 63] : '='};
		fwrite(quad, 1, sizeof quad, file);
	}
}
