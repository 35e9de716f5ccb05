#include "pass/friction.h"

#include <string.h>

#include "base/key.h"
#include "base/log.h"

typedef struct Names {
	const char** list;
	int count;
} Names;

static int find_name(const Names* names, const char* name) {
	for (int i = 0; i < names->count; ++i)
		if (strcmp(names->list[i], name) == 0) return i;
	return -1;
}

static int place_name(Names* names, const char* name) {
	const int known = find_name(names, name);
	if (known >= 0) return known;
	names->list[names->count] = name;
	return names->count++;
}

static const char* next_name(void* user, int index) {
	const Names* names = user;
	return index < names->count ? names->list[index] : NULL;
}

static JnStatus find_pair_name(const Names* names, const char* path, const char* name, int pair, const char* key,
							   int* out) {
	*out = find_name(names, name);
	if (*out >= 0) return JN_OK;
	const char* near = jn_suggest(name, next_name, (void*)names);
	return jn_error(JN_BAD_INPUT, "%s.pairs[%d].%s: nothing has the surface '%.100s'%s%s%s", path, pair, key, name,
					near != NULL ? "; did you mean '" : "; name it as `surface` of a body's contact or of an obstacle",
					near != NULL ? near : "", near != NULL ? "'?" : "");
}

static JnStatus set_pairs(const JnItems* pairs, const char* path, const Names* names, JnFriction* out) {
	const JnContactPairDef* list = pairs->data;
	for (int i = 0; i < pairs->count; ++i) {
		int first, second;
		JN_TRY(find_pair_name(names, path, list[i].first, i, "first", &first));
		JN_TRY(find_pair_name(names, path, list[i].second, i, "second", &second));
		out->mu[first * names->count + second] = list[i].friction;
		out->mu[second * names->count + first] = list[i].friction;
	}
	return JN_OK;
}

JnStatus jn_friction_create(const JnItems* pairs, double mu, const char* path, int count, const char* const* list,
							JnArena* arena, int* surface_of, JnFriction* out) {
	Names names = {0};
	JN_NEW(arena, names.list, count + 1);
	for (int i = 0; i < count; ++i) surface_of[i] = place_name(&names, list[i]);
	out->surface_count = names.count;
	JN_NEW(arena, out->mu, names.count * names.count + 1);
	for (int i = 0; i < names.count * names.count; ++i) out->mu[i] = mu;
	return set_pairs(pairs, path, &names, out);
}

const JnKey jn_friction_pair_keys[] = {
	{.name = "first",
	 .kind = JN_TEXT,
	 .field = offsetof(JnContactPairDef, first),
	 .required = true,
	 .meaning = "surface of the one, as bodies and obstacles name it"},
	{.name = "second",
	 .kind = JN_TEXT,
	 .field = offsetof(JnContactPairDef, second),
	 .required = true,
	 .meaning = "surface of the other"},
	{.name = "friction",
	 .kind = JN_REAL,
	 .field = offsetof(JnContactPairDef, friction),
	 .required = true,
	 .low = 0,
	 .high = 100,
	 .meaning = "coefficient of Coulomb friction between the two"},
	{0},
};
