// The product of the variations: run i takes value (i / period) of each key, the first key varying slowest.
#include "compare_plan.h"

#include <ctype.h>
#include <math.h>
#include <search.h>
#include <stdio.h>
#include <string.h>

#include "app.h"
#include "base/key.h"

enum { MOST_RUNS = 10000, LABEL_SIZE = 256, NAME_SIZE = 120 };

// Keys whose values say what they are.
static bool is_telling(const char* path) {
	static const char* const telling[] = {"method", "law", "integrator", "material", "controller", "type", "element"};
	const char* dot = strrchr(path, '.');
	for (size_t i = 0; i < sizeof telling / sizeof *telling; ++i)
		if (strcmp(dot != NULL ? dot + 1 : path, telling[i]) == 0) return true;
	return false;
}

static char* copy_trimmed(JnArena* arena, const char* text, size_t length) {
	while (length > 0 && isspace((unsigned char)*text)) ++text, --length;
	while (length > 0 && isspace((unsigned char)text[length - 1])) --length;
	char* copy = jn_arena_take(arena, length + 1, 1);
	if (copy != NULL) memcpy(copy, text, length);
	return copy;
}

// Length of the value at `text`: up to a comma outside brackets and quotes. SIZE_MAX when one stays open.
static size_t measure_value(const char* text) {
	int depth = 0;
	char quote = '\0';
	size_t i = 0;
	for (; text[i] != '\0' && (text[i] != ',' || depth > 0 || quote != '\0'); ++i) {
		if (quote != '\0')
			quote = text[i] == quote ? '\0' : quote;
		else if (text[i] == '\'' || text[i] == '"')
			quote = text[i];
		else if (strchr("[{(", text[i]) != NULL)
			++depth;
		else if (strchr("]})", text[i]) != NULL && --depth < 0)
			return SIZE_MAX;
	}
	return depth > 0 || quote != '\0' ? SIZE_MAX : i;
}

static bool has_value(const CompareKey* key, const char* value) {
	for (int i = 0; i < key->count; ++i)
		if (strcmp(key->values[i], value) == 0) return true;
	return false;
}

static int read_values(JnArena* arena, const char* word, const char* text, CompareKey* key) {
	key->values = jn_arena_take(arena, strlen(text) + 1, sizeof *key->values);
	if (key->values == NULL) return EXIT_RUN_FAILED;
	for (;; ++text) {
		const size_t length = measure_value(text);
		if (length == SIZE_MAX)
			return app_usage_error("compare", "--vary %s: a bracket or quote has no counterpart", word);
		const char* value = copy_trimmed(arena, text, length);
		if (value == NULL) return EXIT_RUN_FAILED;
		if (*value == '\0') return app_usage_error("compare", "--vary %s: value %d is empty", word, key->count + 1);
		if (has_value(key, value)) return app_usage_error("compare", "--vary %s: '%s' comes twice", word, value);
		key->values[key->count++] = value;
		text += length;
		if (*text == '\0') return EXIT_DONE;
	}
}

static int check_assignment(const char* option, const char* word) {
	if (strchr(word, '=') != NULL && *word != '=') return EXIT_DONE;
	return app_usage_error("compare", "--%s %s: write key=value, such as step.dt=5ms", option, word);
}

static int read_key(ComparePlan* plan, const char* word) {
	const int status = check_assignment("vary", word);
	if (status != EXIT_DONE) return status;
	const char* equals = strchr(word, '=');
	CompareKey* key = &plan->keys[plan->key_count];
	key->path = copy_trimmed(&plan->arena, word, (size_t)(equals - word));
	if (key->path == NULL) return EXIT_RUN_FAILED;
	for (int i = 0; i < plan->key_count; ++i)
		if (strcmp(plan->keys[i].path, key->path) == 0)
			return app_usage_error("compare", "--vary %s: this key is varied already; join the values by commas", word);
	if (strcmp(key->path, "step.dt") == 0) plan->dt_key = plan->key_count;
	++plan->key_count;
	return read_values(&plan->arena, word, equals + 1, key);
}

static const char* last_word(const char* path) {
	const char* dot = strrchr(path, '.');
	return dot != NULL ? dot + 1 : path;
}

static void choose_words(ComparePlan* plan) {
	for (int i = 0; i < plan->key_count; ++i) {
		CompareKey* key = &plan->keys[i];
		key->word = last_word(key->path);
		for (int j = 0; j < plan->key_count; ++j)
			if (j != i && strcmp(key->word, last_word(plan->keys[j].path)) == 0) key->word = key->path;
	}
}

static void append_label(const CompareKey* key, const char* value, char label[LABEL_SIZE]) {
	const size_t used = strlen(label);
	const bool is_bare = is_telling(key->path) && key->word != key->path;
	const bool is_root = is_telling(key->path) && strchr(key->path, '.') == NULL;
	snprintf(label + used, LABEL_SIZE - used, "%s%s%s%s", used > 0 ? " " : "", is_bare || is_root ? "" : key->word,
			 is_bare || is_root ? "" : "=", value);
}

// A label as a folder: brackets and quotes go, a space or a colon with its spaces becomes one '_'.
static void form_name(const char* label, char name[NAME_SIZE]) {
	size_t length = 0;
	for (const char* c = label; *c != '\0' && length < NAME_SIZE - 1; ++c) {
		if (isalnum((unsigned char)*c) || strchr("._+-=,", *c) != NULL)
			name[length++] = *c;
		else if (*c == '/')
			name[length++] = '-';
		else if ((*c == ' ' || *c == ':') && length > 0 && name[length - 1] != '_' && name[length - 1] != ',')
			name[length++] = '_';
	}
	while (length > 0 && strchr("_.", name[length - 1]) != NULL) --length;
	name[length] = '\0';
}

typedef struct Name {
	char* text;
	int copies; // runs that would have it
} Name;

static int compare_names(const void* a, const void* b) {
	return strcasecmp(((const Name*)a)->text, ((const Name*)b)->text);
}

// The first of that name, who may be another; NULL: out of memory.
static Name* meet(ComparePlan* plan, char* text) {
	Name* name = jn_arena_take(&plan->arena, 1, sizeof *name);
	if (name == NULL || text == NULL) return NULL;
	name->text = text;
	Name** found = tsearch(name, &plan->names, compare_names);
	return found != NULL ? *found : NULL;
}

// Names that the file system would not tell apart get a number; so do those that were cut.
static const char* unique_name(ComparePlan* plan, const CompareRun* run) {
	char base[NAME_SIZE], numbered[NAME_SIZE + 16];
	form_name(run->label, base);
	if (base[0] == '\0' || base[0] == '.') snprintf(base, sizeof base, "run");
	char* text = jn_arena_text(&plan->arena, base);
	Name *first = meet(plan, text), *own = first;
	while (own != NULL && own->text != text) {
		snprintf(numbered, sizeof numbered, "%s_%d", base, ++first->copies);
		text = jn_arena_text(&plan->arena, numbered);
		own = meet(plan, text);
	}
	if (own != NULL) own->copies = 1;
	return own != NULL ? own->text : NULL;
}

static const char* join(JnArena* arena, const char* key, const char* value) {
	const size_t size = strlen(key) + strlen(value) + 2;
	char* text = jn_arena_take(arena, size, 1);
	if (text != NULL) snprintf(text, size, "%s=%s", key, value);
	return text;
}

// Pictures of each run only when asked for: `sets` come later and win.
static bool begin_sets(ComparePlan* plan, const CompareOptions* options, int extra, CompareRun* run) {
	run->sets = jn_arena_take(&plan->arena, (size_t)options->sets.count + (size_t)extra + 1, sizeof *run->sets);
	run->values = jn_arena_take(&plan->arena, (size_t)plan->key_count, sizeof *run->values);
	if (run->sets == NULL || run->values == NULL) return false;
	run->sets[run->set_count++] = "record.plots=no";
	for (int i = 0; i < options->sets.count; ++i) run->sets[run->set_count++] = options->sets.words[i];
	return true;
}

static int fill_run(ComparePlan* plan, const CompareOptions* options, int index) {
	CompareRun* run = &plan->runs[index];
	char label[LABEL_SIZE] = "", group[LABEL_SIZE] = "";
	if (!begin_sets(plan, options, plan->key_count, run)) return EXIT_RUN_FAILED;
	run->dt = NAN;
	int rest = index, period = plan->run_count;
	for (int k = 0; k < plan->key_count; ++k) {
		const CompareKey* key = &plan->keys[k];
		period /= key->count;
		const char* value = key->values[rest / period];
		if (k == plan->dt_key) jn_quantity_parse(value, "s", &run->dt);
		if (k != plan->dt_key) run->group = run->group * key->count + rest / period;
		if (k != plan->dt_key) append_label(key, value, group);
		append_label(key, value, label);
		run->values[k] = value;
		run->sets[run->set_count++] = join(&plan->arena, key->path, value);
		if (run->sets[run->set_count - 1] == NULL) return EXIT_RUN_FAILED;
		rest %= period;
	}
	run->label = jn_arena_text(&plan->arena, label);
	plan->groups[run->group] = jn_arena_text(&plan->arena, group);
	run->name = run->label != NULL ? unique_name(plan, run) : NULL;
	return run->name != NULL && plan->groups[run->group] != NULL ? EXIT_DONE : EXIT_RUN_FAILED;
}

// The value that the reference sets for a key, or "".
static const char* reference_value(const CompareOptions* options, const char* path) {
	const char* value = "";
	const size_t length = strlen(path);
	for (int i = 0; i < options->reference.count; ++i) {
		const char* word = options->reference.words[i];
		if (strncmp(word, path, length) == 0 && word[length] == '=') value = word + length + 1;
	}
	return value;
}

static int fill_reference(ComparePlan* plan, const CompareOptions* options) {
	CompareRun* run = &plan->runs[plan->run_count];
	*run = (CompareRun){.label = "reference", .is_reference = true, .dt = NAN, .group = -1};
	if (!begin_sets(plan, options, options->reference.count, run)) return EXIT_RUN_FAILED;
	for (int i = 0; i < options->reference.count; ++i) {
		const int status = check_assignment("reference", options->reference.words[i]);
		if (status != EXIT_DONE) return status;
		run->sets[run->set_count++] = options->reference.words[i];
	}
	for (int k = 0; k < plan->key_count; ++k) run->values[k] = reference_value(options, plan->keys[k].path);
	plan->has_reference = true;
	run->name = unique_name(plan, run);
	++plan->run_count;
	return run->name != NULL ? EXIT_DONE : EXIT_RUN_FAILED;
}

static int count_runs(ComparePlan* plan) {
	plan->run_count = 1;
	for (int k = 0; k < plan->key_count; ++k) {
		plan->run_count *= plan->keys[k].count;
		if (plan->run_count > MOST_RUNS)
			return app_usage_error("compare", "more than %d combinations are varied; vary less at a time", MOST_RUNS);
	}
	plan->group_count = plan->run_count / (plan->dt_key >= 0 ? plan->keys[plan->dt_key].count : 1);
	return EXIT_DONE;
}

int compare_plan_create(const CompareOptions* options, ComparePlan* plan) {
	*plan = (ComparePlan){.dt_key = -1};
	plan->keys = jn_arena_take(&plan->arena, (size_t)options->vary.count, sizeof *plan->keys);
	if (plan->keys == NULL) return EXIT_RUN_FAILED;
	int status = EXIT_DONE;
	for (int i = 0; i < options->vary.count && status == EXIT_DONE; ++i)
		status = read_key(plan, options->vary.words[i]);
	if (status == EXIT_DONE) status = count_runs(plan);
	if (status != EXIT_DONE) return status;
	choose_words(plan);
	plan->runs = jn_arena_take(&plan->arena, (size_t)plan->run_count + 1, sizeof *plan->runs);
	plan->groups = jn_arena_take(&plan->arena, (size_t)plan->group_count, sizeof *plan->groups);
	if (plan->runs == NULL || plan->groups == NULL) return EXIT_RUN_FAILED;
	for (int i = 0; i < plan->run_count && status == EXIT_DONE; ++i) status = fill_run(plan, options, i);
	return status == EXIT_DONE && options->reference.count > 0 ? fill_reference(plan, options) : status;
}

static void forget_names(ComparePlan* plan) {
	while (plan->names != NULL) tdelete(*(Name**)plan->names, &plan->names, compare_names);
}

void compare_plan_free(ComparePlan* plan) {
	forget_names(plan);
	jn_arena_free(&plan->arena);
}
