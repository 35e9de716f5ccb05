// Reading of the kinds that hold no table: numbers with units and bounds, switches, texts, choices, fixed lists.
#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/key_reader.h"
#include "base/quantity.h"

// Products of some such numbers are still numbers: squares of lengths, volumes, energies.
static const double largest = 1e30, smallest = 1e-30;

static bool is_inside(const JnKey* key, double value) {
	if (key->low == 0 && key->high == 0) return true;
	const bool above = (key->open & JN_OPEN_LOW) != 0 ? value > key->low : value >= key->low;
	const bool below = (key->open & JN_OPEN_HIGH) != 0 ? value < key->high : value <= key->high;
	return above && below;
}

static JnStatus check_size(const JnKeyReader* reader, const char* unit, const JnNode* node, double value) {
	if (fabs(value) <= largest) return JN_OK;
	return jn_key_error(reader, node, "%.100s is beyond %g%s%s, the largest that a number here may be", node->scalar,
						largest, unit != NULL ? " " : "", unit != NULL ? unit : "");
}

static JnStatus check_bounds(const JnKeyReader* reader, const JnKey* key, const JnNode* node, double value) {
	if ((key->low == 0 && key->high == 0) || isinf(key->high)) JN_TRY(check_size(reader, key->unit, node, value));
	const bool is_tiny = key->low == 0 && (key->open & JN_OPEN_LOW) != 0 && value > 0 && value < smallest;
	if (is_tiny)
		return jn_key_error(reader, node, "%.100s is below %g%s%s, the smallest that a number here may be",
							node->scalar, smallest, key->unit != NULL ? " " : "", key->unit != NULL ? key->unit : "");
	if (is_inside(key, value)) return JN_OK;
	char bounds[96];
	jn_bounds_text(key, sizeof bounds, bounds);
	const char* unit = key->unit != NULL ? key->unit : "";
	return jn_key_error(reader, node, "%.100s is outside %s%s%s%s%s", node->scalar, bounds, unit[0] != '\0' ? " " : "",
						unit, key->remedy != NULL ? "; " : "", key->remedy != NULL ? key->remedy : "");
}

static JnStatus read_number(JnKeyReader* reader, const char* unit, const JnNode* node, double* value) {
	char sentence[512];
	if (node->kind != JN_NODE_SCALAR || node->scalar[0] == '\0') {
		jn_quantity_expect(unit, sizeof sentence, sentence);
		return jn_key_kind_error(reader, node, sentence);
	}
	const char* unit_text;
	if (jn_quantity_read(node->scalar, unit, value, &unit_text) == JN_QUANTITY_FINE) return JN_OK;
	jn_quantity_explain(node->scalar, unit, sizeof sentence, sentence);
	return jn_key_error(reader, node, "%s", sentence);
}

JnStatus jn_read_real(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	double value = 0;
	JN_TRY(read_number(reader, key->unit, node, &value));
	JN_TRY(check_bounds(reader, key, node, value));
	*(double*)field = value;
	return JN_OK;
}

JnStatus jn_read_integer(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	double value = 0;
	JN_TRY(read_number(reader, key->unit, node, &value));
	if (value != floor(value)) {
		return jn_key_error(reader, node, "'%.100s' is no whole number, but one is expected", node->scalar);
	}
	if (fabs(value) > INT_MAX) {
		return jn_key_error(reader, node, "%.100s is too large; at most %d is allowed", node->scalar, INT_MAX);
	}
	JN_TRY(check_bounds(reader, key, node, value));
	*(int*)field = (int)value;
	return JN_OK;
}

JnStatus jn_read_switch(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	static const char* const words[] = {"false", "true", "no", "yes", "off", "on"};
	(void)key;
	if (node->kind != JN_NODE_SCALAR) return jn_key_kind_error(reader, node, "true or false is expected");
	for (int i = 0; i < 6; i++) {
		if (strcasecmp(node->scalar, words[i]) != 0) continue;
		*(bool*)field = i % 2 == 1;
		return JN_OK;
	}
	return jn_key_error(reader, node, "'%.100s' is neither true nor false", node->scalar);
}

JnStatus jn_read_text(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	(void)key;
	if (node->kind != JN_NODE_SCALAR) return jn_key_kind_error(reader, node, "a text is expected");
	char* copy = jn_arena_text(reader->arena, node->scalar);
	*(const char**)field = copy;
	return copy != NULL ? JN_OK : JN_OUT_OF_MEMORY;
}

JnStatus jn_read_path(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	const char* path = NULL;
	JN_TRY(jn_read_text(reader, key, node, &path));
	assert(path != NULL);
	if (path[0] == '\0') return jn_key_error(reader, node, "is empty, but the path of a file is expected");
	const char* slash = node->line > 0 ? strrchr(node->source, '/') : NULL; // an override has no line, and no folder
	const bool is_beside = path[0] != '/' && slash != NULL;
	const int folder = is_beside ? (int)(slash - node->source) + 1 : 0;
	const size_t length = (size_t)folder + strlen(path) + 1;
	char* whole = jn_arena_take(reader->arena, length, 1);
	if (whole == NULL) return JN_OUT_OF_MEMORY;
	snprintf(whole, length, "%.*s%s", folder, node->source, path);
	*(const char**)field = whole;
	return JN_OK;
}

typedef JnStatus (*ReadValue)(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);

static JnStatus read_tuple(JnKeyReader* reader, const JnKey* key, const JnNode* node, ReadValue read, int count,
						   size_t size, char* fields) {
	const char* number = count == 2 ? "two" : "three";
	if (node->kind != JN_NODE_SEQUENCE) {
		char expected[96];
		snprintf(expected, sizeof expected, "a list of %s numbers is expected, such as [1, 2%s]", number,
				 count == 2 ? "" : ", 3");
		return jn_key_kind_error(reader, node, expected);
	}
	if (node->count != count)
		return jn_key_error(reader, node, "is a list of %d, but %s numbers are expected", node->count, number);
	for (int i = 0; i < count; i++) {
		const size_t mark = jn_key_enter(reader, NULL, i);
		JN_TRY(read(reader, key, node->children[i], fields + (size_t)i * size));
		jn_key_leave(reader, mark);
	}
	return JN_OK;
}

JnStatus jn_read_real2(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	return read_tuple(reader, key, node, jn_read_real, 2, sizeof(double), field);
}

JnStatus jn_read_integer2(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	return read_tuple(reader, key, node, jn_read_integer, 2, sizeof(int), field);
}

JnStatus jn_read_real3(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	return read_tuple(reader, key, node, jn_read_real, 3, sizeof(double), field);
}

JnStatus jn_read_integer3(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	return read_tuple(reader, key, node, jn_read_integer, 3, sizeof(int), field);
}

static JnStatus read_point(JnKeyReader* reader, const JnKey* key, const JnNode* node, double point[2]) {
	const char* expected = "a pair [time, value] is expected";
	if (node->kind != JN_NODE_SEQUENCE) return jn_key_kind_error(reader, node, expected);
	if (node->count != 2) return jn_key_error(reader, node, "is a list of %d, but %s", node->count, expected);
	size_t mark = jn_key_enter(reader, NULL, 0);
	JN_TRY(read_number(reader, "s", node->children[0], &point[0]));
	JN_TRY(check_size(reader, "s", node->children[0], point[0]));
	jn_key_leave(reader, mark);
	mark = jn_key_enter(reader, NULL, 1);
	JN_TRY(jn_read_real(reader, key, node->children[1], &point[1]));
	jn_key_leave(reader, mark);
	return JN_OK;
}

JnStatus jn_read_points(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	JnPoints* points = field;
	if (node->kind != JN_NODE_SEQUENCE) {
		return jn_key_kind_error(reader, node, "a list of pairs is expected, such as [[0, 0], [1 s, 5]]");
	}
	JN_NEW(reader->arena, points->data, node->count);
	points->count = node->count;
	for (int i = 0; i < node->count; i++) {
		const size_t mark = jn_key_enter(reader, NULL, i);
		JN_TRY(read_point(reader, key, node->children[i], points->data[i]));
		jn_key_leave(reader, mark);
	}
	return JN_OK;
}

JnStatus jn_read_choice(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field) {
	const JnNames names = {.words = key->names};
	char list[512], near[128];
	jn_names_list(names, sizeof list, list);
	if (node->kind != JN_NODE_SCALAR) {
		char expected[600];
		snprintf(expected, sizeof expected, "one word is expected: %s", list);
		return jn_key_kind_error(reader, node, expected);
	}
	for (int i = 0; key->names[i] != NULL; i++) {
		if (strcmp(node->scalar, key->names[i]) != 0) continue;
		*(int*)field = i;
		return JN_OK;
	}
	jn_names_suggest(names, node->scalar, sizeof near, near);
	return jn_key_error(reader, node, "'%.100s' is no choice here%s%s Choices: %s", node->scalar, near,
						near[0] != '\0' ? "" : ".", list);
}

static void fill_reals(const JnKey* key, bool is_known, int count, double* field) {
	for (int i = 0; i < count; i++) field[i] = is_known ? key->value[i] : (double)NAN;
}

JnStatus jn_default_value(JnKeyReader* reader, const JnKey* key, void* field) {
	const bool is_known = !key->required && !key->absent_allowed;
	switch (key->kind) {
	case JN_REAL:
		fill_reals(key, is_known, 1, field);
		break;
	case JN_REAL2:
		fill_reals(key, is_known, 2, field);
		break;
	case JN_REAL3:
		fill_reals(key, is_known, 3, field);
		break;
	case JN_SWITCH:
		*(bool*)field = is_known && key->value[0] != 0;
		break;
	case JN_TEXT:
	case JN_PATH:
		*(const char**)field = key->text != NULL && is_known ? jn_arena_text(reader->arena, key->text) : NULL;
		return *(const char**)field == NULL && key->text != NULL && is_known ? JN_OUT_OF_MEMORY : JN_OK;
	case JN_INTEGER:
	case JN_CHOICE:
		*(int*)field = is_known ? (int)key->value[0] : 0;
		break;
	case JN_INTEGER2:
		for (int i = 0; i < 2; i++) ((int*)field)[i] = is_known ? (int)key->value[i] : 0;
		break;
	case JN_INTEGER3:
		for (int i = 0; i < 3; i++) ((int*)field)[i] = is_known ? (int)key->value[i] : 0;
		break;
	default:
		*(JnPoints*)field = (JnPoints){0};
		break;
	}
	return JN_OK;
}
