#include "draw.h"

#include <fnmatch.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double usual_chance = 0.3;

const Hint* hint_for(const char* path) {
	static const Hint none = {.chance = 0};
	for (const Hint* hint = hints; hint->path != NULL; ++hint)
		if (fnmatch(hint->path, path, 0) == 0) return hint;
	return &none;
}

const char* word_at(const char* words, int index) {
	static char word[256];
	for (; index > 0 && words != NULL; --index) {
		words = strchr(words, '|');
		if (words != NULL) ++words;
	}
	if (words == NULL) return NULL;
	snprintf(word, sizeof word, "%.*s", (int)strcspn(words, "|"), words);
	return word;
}

const char* draw_word(JnRandom* random, const char* words) {
	int count = 1;
	for (const char* c = words; *c != '\0'; ++c) count += *c == '|';
	return word_at(words, draw_integer(random, 0, count - 1));
}

bool draw_chance(JnRandom* random, double probability) {
	return jn_random_uniform(random) < (probability == 0 ? usual_chance : probability);
}

int draw_integer(JnRandom* random, int low, int high) {
	return low + (int)(jn_random_uniform(random) * (high - low + 1.0));
}

static double between(JnRandom* random, double low, double high) {
	const double u = jn_random_uniform(random);
	if (low > 0) return fmin(fmax(low * pow(high / low, u), low), high);
	return low + u * (high - low);
}

static double any_size(JnRandom* random) {
	const double luck = jn_random_uniform(random), most = luck < 0.7 ? 9 : luck < 0.98 ? 30 : 300;
	return pow(10, between(random, -most, most));
}

// Bounds themselves, or the next number inside, in a third of the draws.
static double at_bound(const JnKey* key, bool is_high) {
	const double bound = is_high ? key->high : key->low;
	const int open = key->open & (is_high ? JN_OPEN_HIGH : JN_OPEN_LOW);
	if (isinf(bound)) return 1e30; // the largest number, and the smallest, of any key
	if (bound == 0 && open != 0) return 1e-30;
	if (key->kind == JN_INTEGER || key->kind == JN_INTEGER2 || key->kind == JN_INTEGER3) return bound;
	return open != 0 ? nextafter(bound, is_high ? -INFINITY : INFINITY) : bound;
}

static double draw_wild(JnRandom* random, const JnKey* key) {
	const bool is_free = key->low == 0 && key->high == 0;
	const double luck = jn_random_uniform(random);
	if (is_free) return luck < 0.1 ? 0 : luck < 0.55 ? any_size(random) : -any_size(random);
	if (luck < 1.0 / 3) return at_bound(key, luck < 1.0 / 6);
	if (key->low < 0) return between(random, key->low, fmin(key->high, 1e300)) * (luck < 0.6 ? 1 : 1e-6);
	const double high = isinf(key->high) ? 1e300 : key->high;
	const double value = isinf(key->high) ? any_size(random) : between(random, fmax(key->low, high * 1e-15), high);
	return fmin(fmax(value, at_bound(key, false)), at_bound(key, true));
}

static double draw_calm(JnRandom* random, const JnKey* key, const Hint* hint) {
	if (hint->low != 0 || hint->high != 0) return between(random, hint->low, hint->high);
	if (key->low == 0 && key->high == 0) return between(random, -1, 1);
	const double high = isinf(key->high) ? 1e3 : key->high;
	const double low = key->low == 0 && high > 10 ? high * 1e-6 : key->low;
	return fmin(fmax(between(random, low, high), at_bound(key, false)), at_bound(key, true));
}

double draw_number(JnRandom* random, const JnKey* key, const Hint* hint, bool is_wild) {
	const double value = is_wild && !hint->is_hard ? draw_wild(random, key) : draw_calm(random, key, hint);
	const bool is_whole = key->kind == JN_INTEGER || key->kind == JN_INTEGER2 || key->kind == JN_INTEGER3;
	return is_whole ? fmin(fmax(floor(value + 0.5), -INT_MAX), INT_MAX) : value;
}
