// Key tables: a small struct with a field of every kind is filled from text, each refusal is met once with its words,
// and the tables describe themselves.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "base/document.h"
#include "base/key.h"

typedef struct Step {
	double dt;
	int controller;
} Step;

typedef struct Contact {
	double stiffness, gap;
} Contact;

typedef struct Solid {
	double young, poisson;
} Solid;

typedef struct Body {
	const char* name;
	double density;
	JnVariant material;
} Body;

typedef struct Method {
	double gamma;
} Method;

typedef struct Scene {
	Step step;
	int steps;
	bool is_quiet;
	const char *title, *note;
	double gravity[3], center[3], end;
	int cells[3];
	JnPoints drive;
	Contact* contact;
	JnItems bodies;
	JnVariant integrator, noise;
} Scene;

static const char* const controllers[] = {"fixed", "force_error", "embedded", NULL};

static const JnKey step_keys[] = {
	{.name = "dt",
	 .kind = JN_REAL,
	 .field = offsetof(Step, dt),
	 .value = {1e-3},
	 .high = 1,
	 .open = JN_OPEN_LOW,
	 .unit = "s",
	 .meaning = "time step"},
	{.name = "controller",
	 .kind = JN_CHOICE,
	 .field = offsetof(Step, controller),
	 .value = {1},
	 .names = controllers,
	 .meaning = "what picks the step"},
	{0},
};

static const JnKey contact_keys[] = {
	{.name = "stiffness",
	 .kind = JN_REAL,
	 .field = offsetof(Contact, stiffness),
	 .required = true,
	 .unit = "N/m",
	 .meaning = "penalty"},
	{.name = "gap", .kind = JN_REAL, .field = offsetof(Contact, gap), .value = {0.5}, .unit = "m"},
	{0},
};

static const JnKey solid_keys[] = {
	{.name = "young",
	 .kind = JN_REAL,
	 .field = offsetof(Solid, young),
	 .value = {1e5},
	 .high = INFINITY,
	 .open = JN_OPEN_LOW,
	 .unit = "Pa",
	 .meaning = "Young's modulus"},
	{.name = "poisson",
	 .kind = JN_REAL,
	 .field = offsetof(Solid, poisson),
	 .value = {0.3},
	 .high = 0.5,
	 .open = JN_OPEN_HIGH,
	 .remedy = "use 0.49 for nearly incompressible",
	 .meaning = "Poisson's ratio"},
	{0},
};

static const JnRow linear = {"linear", "small strains", solid_keys, sizeof(Solid)};
static const JnRow corotated = {"corotated", "large rotations | small strains", solid_keys, sizeof(Solid)};
static const JnRow rigid = {"rigid", "no strain at all", NULL, 0};
static const JnRow* const material_rows[] = {&linear, &corotated, &rigid};
static const JnRowList materials = {"material", material_rows, 3};

static const JnKey body_keys[] = {
	{.name = "name", .kind = JN_TEXT, .field = offsetof(Body, name), .required = true, .meaning = "its name"},
	{.name = "density", .kind = JN_REAL, .field = offsetof(Body, density), .value = {1000}, .unit = "kg/m^3"},
	{.name = "material",
	 .kind = JN_VARIANT,
	 .field = offsetof(Body, material),
	 .text = "linear",
	 .rows = &materials,
	 .tag = "law",
	 .meaning = "what it is made of"},
	{0},
};

static const JnKey method_keys[] = {
	{.name = "gamma", .kind = JN_REAL, .field = offsetof(Method, gamma), .value = {0.29}},
	{0},
};
static const JnRow sdirk2 = {"sdirk2", "two stages", method_keys, sizeof(Method)};
static const JnRow tr_bdf2 = {"tr_bdf2", "trapezoid and BDF2", NULL, 0};
static const JnRow* const method_rows[] = {&sdirk2, &tr_bdf2};
static const JnRowList methods = {"integrator", method_rows, 2};

static const JnKey scene_keys[] = {
	{.name = "step", .kind = JN_OBJECT, .field = offsetof(Scene, step), .keys = step_keys, .meaning = "time stepping"},
	{.name = "steps", .kind = JN_INTEGER, .field = offsetof(Scene, steps), .value = {10}, .low = 1, .high = 1e6},
	{.name = "quiet", .kind = JN_SWITCH, .field = offsetof(Scene, is_quiet), .value = {1}},
	{.name = "title", .kind = JN_TEXT, .field = offsetof(Scene, title), .text = "untitled"},
	{.name = "note", .kind = JN_TEXT, .field = offsetof(Scene, note)},
	{.name = "gravity", .kind = JN_REAL3, .field = offsetof(Scene, gravity), .value = {0, 0, -9.81}, .unit = "m/s^2"},
	{.name = "center", .kind = JN_REAL3, .field = offsetof(Scene, center), .absent_allowed = true, .unit = "m"},
	{.name = "end", .kind = JN_REAL, .field = offsetof(Scene, end), .absent_allowed = true, .unit = "s"},
	{.name = "cells", .kind = JN_INTEGER3, .field = offsetof(Scene, cells), .value = {1, 2, 3}, .low = 1, .high = 99},
	{.name = "drive", .kind = JN_POINTS, .field = offsetof(Scene, drive), .unit = "m"},
	{.name = "contact",
	 .kind = JN_OPTIONAL,
	 .field = offsetof(Scene, contact),
	 .keys = contact_keys,
	 .size = sizeof(Contact)},
	{.name = "bodies",
	 .kind = JN_LIST,
	 .field = offsetof(Scene, bodies),
	 .keys = body_keys,
	 .size = sizeof(Body),
	 .required = true,
	 .meaning = "what moves"},
	{.name = "integrator",
	 .kind = JN_VARIANT,
	 .field = offsetof(Scene, integrator),
	 .text = "sdirk2",
	 .rows = &methods,
	 .tag = "method",
	 .meaning = "how time is stepped"},
	{.name = "noise", .kind = JN_VARIANT, .field = offsetof(Scene, noise), .rows = &methods, .tag = "method"},
	{0},
};

typedef struct Fixture {
	JnArena arena;
	JnDocument document;
	Scene scene;
	char message[2048];
} Fixture;

static void keep_message(void* user, JnLogLevel level, const char* message) {
	(void)level;
	Fixture* fixture = user;
	snprintf(fixture->message, sizeof fixture->message, "%s", message);
}

static int set_up(void** state) {
	Fixture* fixture = calloc(1, sizeof *fixture);
	*state = fixture;
	jn_log_set_sink(keep_message, fixture);
	return fixture == NULL;
}

static int tear_down(void** state) {
	Fixture* fixture = *state;
	jn_log_set_sink(NULL, NULL);
	jn_arena_free(&fixture->arena);
	free(fixture);
	return 0;
}

static JnStatus read_scene(Fixture* fixture, const char* text) {
	memset(&fixture->scene, 0xAA, sizeof fixture->scene); // every field must be written
	fixture->message[0] = '\0';
	assert_int_equal(jn_document_parse("a.yaml", text, &fixture->arena, &fixture->document), JN_OK);
	return jn_keys_read(scene_keys, fixture->document.root, "", &fixture->arena, &fixture->scene);
}

static void expect_read(Fixture* fixture, const char* text) {
	if (read_scene(fixture, text) != JN_OK) fail_msg("'%s' was refused: %s", text, fixture->message);
}

static void expect_message(const Fixture* fixture, const char* part) {
	if (strstr(fixture->message, part) == NULL) fail_msg("message '%s', expected '%s'", fixture->message, part);
}

static void expect_refusal(Fixture* fixture, const char* text, const char* part) {
	assert_int_equal(read_scene(fixture, text), JN_BAD_INPUT);
	expect_message(fixture, part);
}

// Values are compared exactly: each is a constant or one correctly rounded operation.
static void every_kind_is_filled(void** state) {
	Fixture* fixture = *state;
	expect_read(fixture, "step: {dt: 33 ms, controller: embedded}\nsteps: 1e3\nquiet: off\ntitle: beam\nnote: ''\n"
						 "gravity: [0, 1 m/s^2, -3]\ncenter: [10 cm, 0, 1/4 m]\nend: 2 min\ncells: [4, 5, 6]\n"
						 "drive: [[0, 1], [5 ms, 2 cm]]\ncontact: {stiffness: 2 kN/m}\n"
						 "bodies:\n- {name: a}\n- {name: b, density: 1 g/cm^3, material: rigid}\n"
						 "- name: c\n  material: {law: corotated, young: 1 MPa}\n"
						 "integrator: {method: sdirk2, gamma: 0.5}\nnoise: tr_bdf2\n");
	const Scene* scene = &fixture->scene;
	assert_true(scene->step.dt == 0.033 && scene->step.controller == 2);
	assert_int_equal(scene->steps, 1000);
	assert_false(scene->is_quiet);
	assert_string_equal(scene->title, "beam");
	assert_string_equal(scene->note, "");
	assert_true(scene->gravity[0] == 0 && scene->gravity[1] == 1 && scene->gravity[2] == -3);
	assert_true(scene->center[0] == 0.1 && scene->center[2] == 0.25);
	assert_true(scene->end == 120);
	assert_true(scene->cells[0] == 4 && scene->cells[1] == 5 && scene->cells[2] == 6);
	assert_int_equal(scene->drive.count, 2);
	assert_true(scene->drive.data[1][0] == 0.005 && scene->drive.data[1][1] == 0.02);
	assert_true(scene->contact->stiffness == 2000 && scene->contact->gap == 0.5);
	assert_int_equal(scene->bodies.count, 3);
	const Body* bodies = scene->bodies.data;
	assert_string_equal(bodies[1].name, "b");
	assert_true(bodies[0].density == 1000 && bodies[1].density == 1000);
	assert_ptr_equal(bodies[0].material.row, &linear);
	assert_true(((const Solid*)bodies[0].material.options)->poisson == 0.3);
	assert_ptr_equal(bodies[1].material.row, &rigid);
	assert_null(bodies[1].material.options);
	assert_ptr_equal(bodies[2].material.row, &corotated);
	assert_true(((const Solid*)bodies[2].material.options)->young == 1e6);
	assert_true(((const Method*)scene->integrator.options)->gamma == 0.5);
	assert_ptr_equal(scene->noise.row, &tr_bdf2);
}

static void check_defaults(const Scene* scene) {
	assert_true(scene->step.dt == 1e-3 && scene->step.controller == 1);
	assert_int_equal(scene->steps, 10);
	assert_true(scene->is_quiet);
	assert_string_equal(scene->title, "untitled");
	assert_null(scene->note);
	assert_true(scene->gravity[2] == -9.81);
	assert_true(isnan(scene->center[0]) && isnan(scene->center[1]) && isnan(scene->center[2]) && isnan(scene->end));
	assert_true(scene->cells[0] == 1 && scene->cells[1] == 2 && scene->cells[2] == 3);
	assert_int_equal(scene->drive.count, 0);
	assert_null(scene->drive.data);
	assert_null(scene->contact);
	assert_int_equal(scene->bodies.count, 0);
	assert_ptr_equal(scene->integrator.row, &sdirk2);
	assert_true(((const Method*)scene->integrator.options)->gamma == 0.29);
	assert_null(scene->noise.row);
}

static void absent_keys_take_their_defaults(void** state) {
	Fixture* fixture = *state;
	expect_read(fixture, "bodies: []\n");
	check_defaults(&fixture->scene);
}

static void no_mapping_gives_defaults_without_required_keys(void** state) {
	Fixture* fixture = *state;
	memset(&fixture->scene, 0xAA, sizeof fixture->scene);
	assert_int_equal(jn_keys_read(scene_keys, NULL, "", &fixture->arena, &fixture->scene), JN_OK);
	check_defaults(&fixture->scene);
}

static void null_leaves_an_optional_part_out(void** state) {
	Fixture* fixture = *state;
	expect_read(fixture, "bodies: []\ncontact: null\n");
	assert_null(fixture->scene.contact);
}

static void switches_take_six_words(void** state) {
	Fixture* fixture = *state;
	static const char* const words[] = {"true", "yes", "on", "false", "No", "OFF"};
	for (int i = 0; i < 6; i++) {
		char text[64];
		snprintf(text, sizeof text, "bodies: []\nquiet: %s\n", words[i]);
		expect_read(fixture, text);
		assert_int_equal(fixture->scene.is_quiet, i < 3);
	}
}

static void variant_without_tag_takes_the_default_row(void** state) {
	Fixture* fixture = *state;
	expect_read(fixture, "bodies: []\nintegrator: {gamma: 0.1}\n");
	assert_ptr_equal(fixture->scene.integrator.row, &sdirk2);
	assert_true(((const Method*)fixture->scene.integrator.options)->gamma == 0.1);
}

static void values_outside_bounds_are_refused_with_the_remedy(void** state) {
	Fixture* fixture = *state;
	expect_refusal(
		fixture, "bodies:\n  - name: a\n    material:\n      law: linear\n      poisson: 0.51\n",
		"a.yaml:5:7: bodies[0].material.poisson: 0.51 is outside [0, 0.5); use 0.49 for nearly incompressible");
	expect_refusal(fixture, "bodies: []\nstep:\n  dt: 5 min\n", "a.yaml:3:3: step.dt: 5 min is outside (0, 1] s");
	expect_refusal(fixture, "step: {dt: 0}\n", "a.yaml:1:8: step.dt: 0 is outside (0, 1] s");
	expect_refusal(fixture, "steps: 0\n", "steps: 0 is outside [1, 1000000]");
	expect_refusal(fixture, "cells: [1, 2, 100]\n", "a.yaml:1:15: cells[2]: 100 is outside [1, 99]");
	expect_refusal(fixture, "bodies: [{name: a, material: {young: -1 Pa}}]\n", "-1 Pa is outside (0, infinity) Pa");
}

// Their squares and products overflow, or vanish.
static void numbers_too_large_or_too_small_for_arithmetic_are_refused(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "bodies: [{name: a, material: {young: 2e30 Pa}}]\n",
				   "bodies[0].material.young: 2e30 Pa is beyond 1e+30 Pa, the largest that a number here may be");
	expect_refusal(fixture, "bodies: [{name: a, material: {young: 1e-31}}]\n",
				   "bodies[0].material.young: 1e-31 is below 1e-30 Pa, the smallest that a number here may be");
	expect_read(fixture, "bodies: [{name: a, material: {young: 1e30}}]\n");
	expect_read(fixture, "bodies: [{name: a, material: {young: 1e-30}}]\n");
}

static void bounds_that_are_inside_are_taken(void** state) {
	Fixture* fixture = *state;
	expect_read(fixture, "bodies: [{name: a, material: {poisson: 0}}]\nstep: {dt: 1}\nsteps: 1\ncells: [99, 1, 1]\n");
}

static void unknown_keys_are_refused_with_a_suggestion(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "step:\n  dtt: 1\n",
				   "a.yaml:2:3: step.dtt: unknown key; did you mean 'dt'? Keys here: dt, controller");
	expect_refusal(fixture, "garvity: 1\n",
				   "a.yaml:1:1: garvity: unknown key; did you mean 'gravity'? Keys here: step, ");
	expect_refusal(fixture, "step: {zzz: 1}\n", "step.zzz: unknown key. Keys here: dt, controller");
	expect_refusal(
		fixture, "bodies: []\nintegrator: {gama: 1}\n",
		"integrator.gama: unknown key; did you mean 'gamma'? Keys here of the integrator 'sdirk2': method, gamma");
	expect_refusal(fixture, "bodies: []\nintegrator: {method: tr_bdf2, gamma: 1}\n",
				   "integrator.gamma: unknown key. Keys here of the integrator 'tr_bdf2': method");
}

static void missing_required_keys_are_named_with_their_meaning(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "title: a\n", "a.yaml:1:1: the required key 'bodies' is missing (what moves)");
	expect_refusal(fixture, "bodies:\n  - {name: a}\n  - density: 1\n",
				   "a.yaml:3:5: bodies[1]: the required key 'name' is missing (its name)");
	expect_refusal(fixture, "contact: {gap: 1}\n",
				   "a.yaml:1:1: contact: the required key 'stiffness' is missing (penalty)");
	expect_refusal(fixture, "bodies: []\nnoise: {}\n",
				   "a.yaml:2:1: noise: the required key 'method' is missing (one of: sdirk2, tr_bdf2)");
}

static void wrong_node_kinds_are_refused(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "step: {dt: [1]}\n", "step.dt: is a list, but a time is expected, such as 33 ms");
	expect_refusal(fixture, "step: {dt: }\n", "step.dt: is empty, but a time is expected");
	expect_refusal(fixture, "steps: [1]\n", "steps: is a list, but a number is expected");
	expect_refusal(fixture, "steps: {a: 1}\n", "steps: is a mapping, but a number is expected");
	expect_refusal(fixture, "step: 3\n", "step: '3' is a single value, but 'key: value' lines are expected");
	expect_refusal(fixture, "step:\n",
				   "step: is empty, but 'key: value' lines are expected; write {} for the defaults");
	expect_refusal(fixture, "contact: [1]\n", "contact: is a list, but 'key: value' lines");
	expect_refusal(fixture, "bodies: {name: a}\n", "bodies: is a mapping, but a list is expected");
	expect_refusal(fixture, "bodies: [3]\n", "bodies[0]: '3' is a single value, but 'key: value' lines");
	expect_refusal(fixture, "quiet: [on]\n", "quiet: is a list, but true or false is expected");
	expect_refusal(fixture, "title: {a: b}\n", "title: is a mapping, but a text is expected");
	expect_refusal(fixture, "step: {controller: [fixed]}\n", "is a list, but one word is expected: fixed, force_error");
	expect_refusal(fixture, "gravity: 3\n", "gravity: '3' is a single value, but a list of three numbers");
	expect_refusal(fixture, "drive: 3\n", "drive: '3' is a single value, but a list of pairs");
	expect_refusal(fixture, "drive: [3]\n", "drive[0]: '3' is a single value, but a pair [time, value]");
	expect_refusal(fixture, "bodies: []\nintegrator: [a]\n", "integrator: is a list, but the name of one integrator");
	expect_refusal(fixture, "bodies: []\nintegrator:\n", "integrator: is empty, but the name of one integrator");
	expect_refusal(fixture, "bodies: []\nintegrator: {method: [a]}\n", "integrator.method: is a list, but one word");
}

static void wrong_lengths_are_refused(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "gravity: [1, 2]\n", "gravity: is a list of 2, but three numbers are expected");
	expect_refusal(fixture, "cells: [1, 2, 3, 4]\n", "cells: is a list of 4, but three numbers are expected");
	expect_refusal(fixture, "drive: [[0, 1], [1]]\n", "drive[1]: is a list of 1, but a pair [time, value] is expected");
}

static void bad_numbers_and_units_are_refused(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "step: {dt: 33 kg}\n",
				   "step.dt: '33 kg' has the unit kg, but a time is expected, such as 33 ms");
	expect_refusal(fixture, "gravity: [0, 0, down]\n",
				   "gravity[2]: 'down' is no number, but an acceleration is expected");
	expect_refusal(fixture, "end: .inf\n", "end: '.inf' is no finite number");
	expect_refusal(fixture, "end: NaN\n", "end: 'NaN' is no finite number");
	expect_refusal(fixture, "steps: 2.5\n", "a.yaml:1:1: steps: '2.5' is no whole number");
	expect_refusal(fixture, "steps: 1e10\n", "steps: 1e10 is too large; at most 2147483647");
	expect_refusal(fixture, "steps: 3 m\n", "steps: '3 m' has the unit m, but a number without a unit is expected");
	expect_refusal(fixture, "drive: [[1 m, 1]]\n", "drive[0][0]: '1 m' has the unit m, but a time is expected");
	expect_refusal(fixture, "drive: [[1, 1 s]]\n", "drive[0][1]: '1 s' has the unit s, but a length is expected");
}

static void unknown_words_are_refused_with_the_choices(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "quiet: maybe\n", "quiet: 'maybe' is neither true nor false");
	expect_refusal(fixture, "step: {controller: fixd}\n",
				   "'fixd' is no choice here; did you mean 'fixed'? Choices: fixed, force_error, embedded");
	expect_refusal(fixture, "step: {controller: zzzz}\n", "'zzzz' is no choice here. Choices: fixed");
	expect_refusal(fixture, "bodies: []\nintegrator:\n  method: sdirk\n",
				   "a.yaml:3:3: integrator.method: there is no integrator 'sdirk'; did you mean 'sdirk2'? 'jounce list "
				   "integrators' shows all");
	expect_refusal(fixture, "bodies: []\nintegrator: euler\n",
				   "a.yaml:2:1: integrator: there is no integrator 'euler'. 'jounce list integrators' shows all");
}

static void overrides_are_read_and_named_in_messages(void** state) {
	Fixture* fixture = *state;
	expect_read(fixture, "bodies:\n  - {name: a, material: {law: linear}}\n");
	JnDocument* document = &fixture->document;
	assert_int_equal(jn_document_set(document, "step.dt=33ms"), JN_OK);
	assert_int_equal(jn_document_set(document, "gravity=[0,0,0]"), JN_OK);
	assert_int_equal(jn_document_set(document, "integrator=tr_bdf2"), JN_OK);
	assert_int_equal(jn_keys_read(scene_keys, document->root, "", &fixture->arena, &fixture->scene), JN_OK);
	assert_true(fixture->scene.step.dt == 0.033 && fixture->scene.gravity[2] == 0);
	assert_ptr_equal(fixture->scene.integrator.row, &tr_bdf2);
	assert_int_equal(jn_document_set(document, "bodies[0].material.poisson=0.5"), JN_OK);
	assert_int_equal(jn_keys_read(scene_keys, document->root, "", &fixture->arena, &fixture->scene), JN_BAD_INPUT);
	expect_message(fixture,
				   "--set bodies[0].material.poisson=0.5: bodies[0].material.poisson: 0.5 is outside [0, 0.5)");
}

static void given_path_leads_the_messages(void** state) {
	Fixture* fixture = *state;
	Step step;
	assert_int_equal(jn_document_parse("a.yaml", "dt: x", &fixture->arena, &fixture->document), JN_OK);
	const JnNode* root = fixture->document.root;
	assert_int_equal(jn_keys_read(step_keys, root, "inner.step", &fixture->arena, &step), JN_BAD_INPUT);
	expect_message(fixture, "a.yaml:1:1: inner.step.dt: 'x' is no number");
}

static const char* next_word(void* context, int index) {
	return ((const char* const*)context)[index];
}

static void suggestions_are_near_in_edits(void** state) {
	(void)state;
	static const char* words[] = {"dt", "gravity", "integrator", "sdirk2", "sdirk3", NULL};
	static const char* const pairs[][2] = {
		{"dtt", "dt"},         {"garvity", "gravity"},      {"GRAVITY", "gravity"},
		{"gravty", "gravity"}, {"integratr", "integrator"}, {"itnegrtaor", "integrator"},
		{"sdirk", "sdirk2"},   {"sdirk3x", "sdirk3"},       {"td", "dt"},
	};
	for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
		const char* near = jn_suggest(pairs[i][0], next_word, words);
		assert_non_null(near);
		assert_string_equal(near, pairs[i][1]);
	}
	assert_null(jn_suggest("zz", next_word, words));
	assert_null(jn_suggest("grvt", next_word, words)); // three edits, one is allowed
	assert_null(jn_suggest("", next_word, words));
	char lengthy[100] = "";
	memset(lengthy, 'a', 99);
	assert_null(jn_suggest(lengthy, next_word, words));
}

static void rows_are_found_by_name(void** state) {
	(void)state;
	assert_ptr_equal(jn_row_find(&methods, "tr_bdf2"), &tr_bdf2);
	assert_null(jn_row_find(&methods, "tr_bdf"));
}

typedef enum Form { TEXT_FORM, MARKDOWN_FORM } Form;

static void describe(const JnKey* keys, const char* path, Form form, size_t size, char* text) {
	FILE* file = tmpfile();
	assert_non_null(file);
	assert_int_equal(jn_keys_describe(keys, path, form == MARKDOWN_FORM, file), JN_OK);
	rewind(file);
	text[fread(text, 1, size - 1, file)] = '\0';
	fclose(file);
}

static void expect_in(const char* text, const char* part) {
	if (strstr(text, part) == NULL) fail_msg("'%s' is not in:\n%s", part, text);
}

static void description_of_a_part_is_aligned(void** state) {
	(void)state;
	char text[4096];
	describe(scene_keys, "step", TEXT_FORM, sizeof text, text);
	assert_string_equal(text, "step          mapping                          time stepping\n"
							  "  dt          number [s]  0.001        (0, 1]  time step\n"
							  "  controller  word        force_error          what picks the step; one of fixed, "
							  "force_error, embedded\n");
}

static void description_of_all_has_every_key_and_row(void** state) {
	(void)state;
	char text[16384];
	describe(scene_keys, "", TEXT_FORM, sizeof text, text);
	for (const JnKey* key = scene_keys; key->name != NULL; key++) expect_in(text, key->name);
	expect_in(text, "law: corotated");
	expect_in(text, "(keys as for linear)");
	expect_in(text, "[0, 0.5)");
	expect_in(text, "required");
	expect_in(text, "[0, 0, -9.81]");
}

static void description_paths_go_through_lists_and_rows(void** state) {
	(void)state;
	char text[4096];
	describe(scene_keys, "bodies[0].material.poisson", TEXT_FORM, sizeof text, text);
	expect_in(text, "law: linear");
	expect_in(text, "Poisson's ratio");
	assert_null(strstr(text, "young"));
	describe(scene_keys, "bodies.material.corotated", TEXT_FORM, sizeof text, text);
	expect_in(text, "law: corotated");
	expect_in(text, "young");
	describe(scene_keys, "integrator.method", TEXT_FORM, sizeof text, text);
	expect_in(text, "method: tr_bdf2");
	describe(scene_keys, "integrator.sdirk2.gamma", TEXT_FORM, sizeof text, text);
	expect_in(text, "0.29");
}

static void unknown_description_paths_get_a_suggestion(void** state) {
	Fixture* fixture = *state;
	assert_int_equal(jn_keys_describe(scene_keys, "bodies.materil", false, stdout), JN_BAD_INPUT);
	expect_message(fixture,
				   "bodies.materil: there is no key 'materil' in bodies; did you mean 'material'? Keys there: name");
	assert_int_equal(jn_keys_describe(scene_keys, "integrator.sdirk", false, stdout), JN_BAD_INPUT);
	expect_message(fixture, "did you mean 'sdirk2'?");
	assert_int_equal(jn_keys_describe(scene_keys, "steps.x", false, stdout), JN_BAD_INPUT);
	expect_message(fixture, "there is no key 'x' in steps. Keys there: none");
}

static void markdown_has_a_table_for_each_mapping(void** state) {
	(void)state;
	char text[16384];
	describe(scene_keys, "", MARKDOWN_FORM, sizeof text, text);
	expect_in(
		text,
		"## Top level\n\n| Key | Kind | Default | Bounds | Meaning |\n|---|---|---|---|---|\n| `step` | mapping |");
	expect_in(text, "## `step`\n\n| Key |");
	expect_in(text, "| `dt` | number [s] | 0.001 | (0, 1] | time step |\n");
	expect_in(text, "## `contact`\n");
	expect_in(text, "## `bodies[]`\n");
	expect_in(text, "## `bodies[].material`\n\nwhat it is made of\n\n| `law` | Meaning | Keys |\n");
	expect_in(text, "| `corotated` | large rotations \\| small strains | as for `linear` |\n");
	expect_in(text, "| `rigid` | no strain at all | none |\n");
	expect_in(text, "## `bodies[].material` with `law: linear`\n\n| Key |");
	describe(scene_keys, "bodies.material.corotated", MARKDOWN_FORM, sizeof text, text);
	expect_in(text, "`law: corotated`\n\nlarge rotations \\| small strains\n\n| Key |");
}

// A row may hold a variant of its own catalogue, such as a method that is composed of methods.
static const JnRowList nested_methods;
static const JnKey composed_keys[] = {
	{.name = "base", .kind = JN_VARIANT, .rows = &nested_methods, .tag = "method"},
	{0},
};
static const JnRow composed = {"composed", "twice another", composed_keys, sizeof(JnVariant)};
static const JnRow* const nested_rows[] = {&composed};
static const JnRowList nested_methods = {"integrator", nested_rows, 1};

static void catalogues_that_hold_themselves_end(void** state) {
	(void)state;
	char text[4096];
	describe(composed_keys, "", TEXT_FORM, sizeof text, text);
	expect_in(text, "(as above)");
	describe(composed_keys, "", MARKDOWN_FORM, sizeof text, text);
	expect_in(text, "with `method: composed`");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(every_kind_is_filled),
		TEST(absent_keys_take_their_defaults),
		TEST(no_mapping_gives_defaults_without_required_keys),
		TEST(null_leaves_an_optional_part_out),
		TEST(switches_take_six_words),
		TEST(variant_without_tag_takes_the_default_row),
		TEST(values_outside_bounds_are_refused_with_the_remedy),
		TEST(numbers_too_large_or_too_small_for_arithmetic_are_refused),
		TEST(bounds_that_are_inside_are_taken),
		TEST(unknown_keys_are_refused_with_a_suggestion),
		TEST(missing_required_keys_are_named_with_their_meaning),
		TEST(wrong_node_kinds_are_refused),
		TEST(wrong_lengths_are_refused),
		TEST(bad_numbers_and_units_are_refused),
		TEST(unknown_words_are_refused_with_the_choices),
		TEST(overrides_are_read_and_named_in_messages),
		TEST(given_path_leads_the_messages),
		TEST(suggestions_are_near_in_edits),
		TEST(rows_are_found_by_name),
		TEST(description_of_a_part_is_aligned),
		TEST(description_of_all_has_every_key_and_row),
		TEST(description_paths_go_through_lists_and_rows),
		TEST(unknown_description_paths_get_a_suggestion),
		TEST(markdown_has_a_table_for_each_mapping),
		TEST(catalogues_that_hold_themselves_end),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
