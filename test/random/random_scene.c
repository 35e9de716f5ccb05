// A walk through the key tables that writes what it passes. A plan says first which rows stand together: the method, the law
// and the controller are counted off by the index, so that all their combinations come; the rest is drawn.
#include "random_scene.h"

#include <string.h>

#include "draw.h"
#include "jounce/scene.h"
#include "plan.h"

typedef struct Writer {
	FILE* out;
	JnRandom random;
	Plan plan;
	char path[256]; // of the table that is being written
	int body;       // that is being written
	bool has_set;   // it names nodes of its own
	int depth;      // of controllers within controllers
} Writer;

static void write_table(Writer* w, const JnKey* keys, const char* skipped);
static void write_value(Writer* w, const JnKey* key, const Hint* hint);

// ---- paths

static size_t path_enter(Writer* w, const char* name) {
	const size_t length = strlen(w->path);
	snprintf(w->path + length, sizeof w->path - length, "%s%s", length > 0 ? "." : "", name);
	return length;
}

static void path_leave(Writer* w, size_t length) {
	w->path[length] = '\0';
}

static bool path_is(const Writer* w, const char* path) {
	return strcmp(w->path, path) == 0;
}

static bool path_ends(const Writer* w, const char* end) {
	const size_t length = strlen(w->path), last = strlen(end);
	return length >= last && strcmp(w->path + length - last, end) == 0;
}

// ---- values

// Bodies stand in a row along x, one beside the other: where they overlap, contact has hardly ever a solution.
static double shift_of(const Writer* w, int i) {
	static const double pitch = 1.5;
	const bool is_position =
		path_ends(w, ".at") || path_ends(w, ".origin") || path_ends(w, ".center") || path_ends(w, ".translate");
	return i == 0 && is_position && strncmp(w->path, "bodies.shape", 12) == 0 ? pitch * w->body : 0;
}

static void write_numbers(Writer* w, const JnKey* key, const Hint* hint, int count) {
	if (count > 1) fputc('[', w->out);
	for (int i = 0; i < count; ++i) {
		const bool is_wild = draw_chance(&w->random, w->plan.wildness);
		fprintf(w->out, "%s%.17g", i > 0 ? ", " : "", draw_number(&w->random, key, hint, is_wild) + shift_of(w, i));
	}
	if (count > 1) fputc(']', w->out);
}

static void write_points(Writer* w, const JnKey* key, const Hint* hint) {
	const int count = draw_integer(&w->random, 1, 4);
	double t = 0;
	fputc('[', w->out);
	for (int i = 0; i < count; ++i) {
		const bool is_wild = draw_chance(&w->random, w->plan.wildness);
		fprintf(w->out, "%s[%.9g, %.17g]", i > 0 ? ", " : "", t, draw_number(&w->random, key, hint, is_wild));
		t += 1e-3 + 0.1 * jn_random_uniform(&w->random);
	}
	fputc(']', w->out);
}

// Sets of the shape, or of the body.
static const char* set_words(const Writer* w) {
	return w->has_set ? "some" : plan_sets(&w->plan.bodies[w->body]);
}

static void write_text(Writer* w, const JnKey* key, const Hint* hint) {
	if (path_ends(w, ".path") && hint->words[0] == '\0')
		fputs(w->plan.bodies[w->body].file, w->out);
	else if (path_ends(w, "where.set"))
		fputs(draw_word(&w->random, set_words(w)), w->out);
	else if (path_is(w, "bodies.name") || path_is(w, "probes.body") || path_is(w, "suture.body"))
		fprintf(w->out, "body_%d", path_is(w, "bodies.name") ? w->body : path_is(w, "suture.body"));
	else if (path_is(w, "suture.thread"))
		fputs("body_0", w->out);
	else if (path_is(w, "obstacles.name") || path_is(w, "probes.name"))
		fprintf(w->out, "item_%d", w->body);
	else
		fputs(hint->words != NULL ? draw_word(&w->random, hint->words)
			  : key->text != NULL ? key->text
								  : "word",
			  w->out);
}

static void write_choice(Writer* w, const JnKey* key) {
	int count = 0;
	while (key->names[count] != NULL) ++count;
	const char* word = key->names[draw_integer(&w->random, 0, count - 1)];
	if (path_is(w, "bodies.damping.stiffness"))
		word = key->names[w->plan.damping_stiffness];
	else if (path_ends(w, ".element") && w->plan.bodies[w->body].element != NULL)
		word = w->plan.bodies[w->body].element;
	else if (path_is(w, "bodies.mass") && w->plan.needs_lumped)
		word = "lumped";
	else if (path_ends(w, ".section") && strcmp(w->plan.bodies[w->body].law->name, "rod") == 0)
		word = "centred";
	fputs(word, w->out);
}

static const JnRow* choose_row(Writer* w, const JnKey* key) {
	if (path_is(w, "bodies.shape")) return w->plan.bodies[w->body].shape;
	if (path_is(w, "bodies.material")) return w->plan.bodies[w->body].law;
	if (path_is(w, "integrator")) return w->plan.method;
	if (path_is(w, "step")) return w->plan.controller;
	if (path_ends(w, "rules")) return plan_controller(&w->plan, &w->random, w->depth < 2);
	return key->rows->rows[draw_integer(&w->random, 0, key->rows->count - 1)];
}

static void write_variant(Writer* w, const JnKey* key) {
	const JnRow* row = choose_row(w, key);
	const size_t length = path_enter(w, row->name);
	++w->depth;
	fprintf(w->out, "{%s: %s", key->tag, row->name);
	write_table(w, row->keys, "");
	fputc('}', w->out);
	--w->depth;
	path_leave(w, length);
}

static void write_item(Writer* w, const JnKey* key) {
	if (key->rows != NULL) {
		write_variant(w, key);
		return;
	}
	fputc('{', w->out);
	write_table(w, key->keys, NULL);
	fputc('}', w->out);
}

static void write_list(Writer* w, const JnKey* key, const Hint* hint) {
	const bool is_bodies = path_is(w, "bodies"),
			   is_named = is_bodies || path_is(w, "obstacles") || path_is(w, "probes");
	const int drawn = draw_integer(&w->random, (int)hint->low, hint->high > 0 ? (int)hint->high : 1);
	const int count = is_bodies ? w->plan.body_count : drawn, body = w->body;
	fputc('[', w->out);
	for (int i = 0; i < count; ++i) {
		if (is_named) w->body = i;
		if (is_bodies) w->has_set = false;
		fputs(i == 0 ? "" : is_named ? ",\n  " : ", ", w->out);
		write_item(w, key);
	}
	fputc(']', w->out);
	w->body = body;
}

static void write_value(Writer* w, const JnKey* key, const Hint* hint) {
	static const int counts[] = {
		[JN_REAL] = 1, [JN_INTEGER] = 1, [JN_REAL2] = 2, [JN_INTEGER2] = 2, [JN_REAL3] = 3, [JN_INTEGER3] = 3};
	if (key->kind == JN_TEXT || key->kind == JN_PATH)
		write_text(w, key, hint);
	else if (path_is(w, "bodies.damping.start"))
		fprintf(w->out, "%.9g", w->plan.damping_start);
	else if (hint->words != NULL)
		fputs(draw_word(&w->random, hint->words), w->out);
	else if (key->kind == JN_SWITCH)
		fputs(draw_integer(&w->random, 0, 1) == 1 ? "true" : "false", w->out);
	else if (key->kind == JN_POINTS)
		write_points(w, key, hint);
	else if (key->kind == JN_CHOICE)
		write_choice(w, key);
	else if (key->kind == JN_VARIANT)
		write_variant(w, key);
	else if (key->kind == JN_LIST)
		write_list(w, key, hint);
	else if (key->keys != NULL)
		write_item(w, key);
	else
		write_numbers(w, key, hint, counts[key->kind]);
}

// ---- tables

static bool is_among(const char* names, const char* name) {
	for (int i = 0; word_at(names, i) != NULL; ++i)
		if (strcmp(word_at(names, i), name) == 0) return true;
	return false;
}

// What `names` has that can stand here.
static void choose_name(Writer* w, const char* names, size_t size, char* chosen) {
	do snprintf(chosen, size, "%s", draw_word(&w->random, names));
	while ((strcmp(chosen, "set") == 0 && set_words(w) == NULL) ||
		   (strcmp(chosen, "along") == 0 && !plan_is_thread(&w->plan.bodies[w->body])) ||
		   (strcmp(chosen, "where") == 0 && w->plan.body_count == 0));
}

static const Choice* choice_for(const char* path) {
	for (const Choice* choice = choices; choice->path != NULL; ++choice) {
		const bool is_prefix = choice->path[0] == '*';
		const char* end = choice->path + is_prefix;
		const size_t length = strlen(path), last = strlen(end);
		if (length >= last && (is_prefix || length == last) && strcmp(path + length - last, end) == 0) return choice;
	}
	return NULL;
}

// Is the key given? What the plan says goes first, then what is required, then chance.
static bool is_given(Writer* w, const JnKey* key, const Hint* hint) {
	const PlanWord word = plan_says(&w->plan, w->path);
	const PlanBody* body = &w->plan.bodies[w->body];
	if (word != PLAN_SAYS_NOTHING) return word == PLAN_SAYS_YES;
	const bool is_rigid = strcmp(body->law != NULL ? body->law->name : "", "rigid") == 0;
	if (path_is(w, "bodies.drive") || (path_is(w, "bodies.fix") && is_rigid))
		return draw_chance(&w->random, is_rigid ? 0.02 : 0.2);
	if (path_is(w, "bodies.shape.file.tetrahedra") || path_is(w, "bodies.shape.file.voxels") ||
		path_is(w, "bodies.shape.file.triangles"))
		return strcmp(key->name, body->filling) == 0;
	if (path_is(w, "bodies.contact.self") && plan_is_cloth(body)) return false;
	if (path_is(w, "probes.body") && w->plan.body_count > 1) return true;
	if (path_is(w, "bodies.material.rigid.stiffness") && w->plan.body_count == 1) return true;
	if (path_ends(w, ".torsion") || path_ends(w, ".bending") || path_ends(w, "torsion_damping"))
		return plan_is_thread(body) && draw_chance(&w->random, 0.5);
	if (path_is(w, "bodies.material.peridynamic.horizon")) return body->has_horizon;
	if (path_is(w, "bodies.material.peridynamic.horizon_spacings")) return !body->has_horizon;
	if (shift_of(w, 0) > 0) return true;
	return key->required || path_ends(w, ".name") || path_ends(w, "where") || path_ends(w, ".element") ||
		   draw_chance(&w->random, hint->chance);
}

static bool write_key(Writer* w, const JnKey* key, const char* chosen, bool is_first) {
	const Choice* choice = choice_for(w->path);
	const bool is_root = w->path[0] == '\0';
	const bool is_choice = choice != NULL && is_among(choice->names, key->name);
	const size_t length = path_enter(w, key->name);
	const Hint* hint = hint_for(w->path);
	const bool is_written = is_choice ? strcmp(chosen, key->name) == 0 : is_given(w, key, hint);
	if (is_written) {
		fprintf(w->out, "%s%s: ", is_first || is_root ? "" : ", ", key->name);
		write_value(w, key, hint);
		if (is_root) fputc('\n', w->out);
		w->has_set |= path_is(w, "bodies.sets");
	}
	path_leave(w, length);
	return is_written;
}

// `skipped` "": something stands before the first key already.
static void write_table(Writer* w, const JnKey* keys, const char* skipped) {
	char chosen[32] = "";
	const Choice* choice = choice_for(w->path);
	bool is_first = skipped == NULL;
	if (choice != NULL) choose_name(w, choice->names, sizeof chosen, chosen);
	for (const JnKey* key = keys; key != NULL && key->name != NULL; ++key)
		if (write_key(w, key, chosen, is_first)) is_first = false;
}

void random_scene_write(uint64_t seed, long index, int attempt, FILE* out) {
	Writer w = {.out = out, .random = {seed * 0x9e3779b97f4a7c15U + (uint64_t)index * 0xbf58476d1ce4e5b9U}};
	w.random.state ^= jn_random_bits(&w.random) + (uint64_t)attempt;
	plan_make(&w.plan, index, &w.random);
	fprintf(out, "# seed %llu, index %ld, attempt %d\n", (unsigned long long)seed, index, attempt);
	write_table(&w, jn_scene_keys, NULL);
}
