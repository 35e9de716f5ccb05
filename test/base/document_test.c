// YAML files as trees with places, what is refused and in which words, and overrides.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "base/document.h"
#include "base/node.h"

typedef struct Fixture {
	JnArena arena;
	JnDocument document;
	char message[2048]; // the last one logged
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

static JnStatus parse(Fixture* fixture, const char* text) {
	fixture->message[0] = '\0';
	return jn_document_parse("a.yaml", text, &fixture->arena, &fixture->document);
}

static void expect_message(const Fixture* fixture, const char* part) {
	if (strstr(fixture->message, part) == NULL) fail_msg("message '%s', expected '%s'", fixture->message, part);
}

static void expect_refusal(Fixture* fixture, const char* text, const char* part) {
	assert_int_equal(parse(fixture, text), JN_BAD_INPUT);
	expect_message(fixture, part);
}

static const JnNode* entry(const JnNode* mapping, const char* name) {
	const JnNode* node = jn_node_find(mapping, name);
	if (node == NULL) fail_msg("there is no entry '%s'", name);
	return node;
}

static void tree_holds_kinds_texts_and_places(void** state) {
	Fixture* fixture = *state;
	assert_int_equal(parse(fixture, "# beam\nname: beam\nbodies:\n  - x: 1\n    y: [2, '3 m']\n"), JN_OK);
	const JnNode* root = fixture->document.root;
	assert_int_equal(root->kind, JN_NODE_MAPPING);
	assert_int_equal(root->count, 2);
	assert_string_equal(entry(root, "name")->scalar, "beam");
	const JnNode* bodies = entry(root, "bodies");
	assert_int_equal(bodies->kind, JN_NODE_SEQUENCE);
	const JnNode* y = entry(bodies->children[0], "y");
	assert_int_equal(y->line, 5);
	assert_int_equal(y->column, 5);
	assert_string_equal(y->children[1]->scalar, "3 m");
	assert_int_equal(y->children[1]->line, 5);
	assert_int_equal(y->children[1]->column, 12);
	assert_string_equal(y->source, "a.yaml");
	assert_null(jn_node_find(root, "nothing"));
	assert_null(jn_node_find(bodies, "x"));
	assert_null(jn_node_find(NULL, "x"));
}

static void long_lists_keep_their_order(void** state) {
	Fixture* fixture = *state;
	char text[8192] = "list: [0";
	for (int i = 1; i < 1000; i++) sprintf(text + strlen(text), ", %d", i);
	strcat(text, "]");
	assert_int_equal(parse(fixture, text), JN_OK);
	const JnNode* list = entry(fixture->document.root, "list");
	assert_int_equal(list->count, 1000);
	for (int i = 0; i < 1000; i++) assert_int_equal(atoi(list->children[i]->scalar), i);
}

static void a_byte_order_mark_is_skipped(void** state) {
	Fixture* fixture = *state;
	assert_int_equal(parse(fixture, "\xEF\xBB\xBF"
									"a: 1\n"),
					 JN_OK);
	assert_string_equal(entry(fixture->document.root, "a")->scalar, "1");
}

static void bad_yaml_is_refused_with_its_place(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "a: 1\nb: [1, 2\n", "a.yaml:3:1: the YAML is broken: ");
	expect_refusal(fixture, "a: [1\nb: 2\n", "that begins on line 1");
	expect_refusal(fixture, "a:\n\tb: 1\n", "indent with spaces, not with tabs");
	expect_refusal(fixture, "a: 1\nb: \xFF\n", "a.yaml:2:4: the text is no valid UTF-8");
	expect_refusal(fixture, "a: \"x\\0y\"\n", "a.yaml:1:4: a zero character");
}

static void duplicate_keys_are_refused(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "a: 1\nb: 2\na: 3\n", "a.yaml:3:1: the key 'a' is given twice, first on line 1");
	expect_refusal(fixture, "s:\n  b: 2\n  b: 3\n", "a.yaml:3:3: the key 'b' is given twice");
}

static void unsupported_yaml_is_refused(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "a: &x 1\nb: 2\n", "a.yaml:1:4: anchors");
	expect_refusal(fixture, "a: &x [1]\n", "anchors");
	expect_refusal(fixture, "a: &x {b: 1}\n", "anchors");
	expect_refusal(fixture, "a: *x\n", "a.yaml:1:4: aliases");
	expect_refusal(fixture, "*x : 1\n", "aliases");
	expect_refusal(fixture, "a: !!float 1\n", "tags");
	expect_refusal(fixture, "a: 1\n---\nb: 2\n", "a.yaml:2:1: a second document");
	expect_refusal(fixture, "? [a, b]\n: 1\n", "a key must be a single word");
	expect_refusal(fixture, "'': 1\n", "a key is missing before ':'");
}

static void root_must_be_a_mapping(void** state) {
	Fixture* fixture = *state;
	expect_refusal(fixture, "", "a.yaml:1:1: the file is empty");
	expect_refusal(fixture, "# nothing\n", "the file is empty");
	expect_refusal(fixture, "- 1\n", "the file is a list");
	expect_refusal(fixture, "beam\n", "the file is a single value");
}

static void depth_ends_at_64_levels(void** state) {
	Fixture* fixture = *state;
	char text[400] = "a: ";
	memset(text + 3, '[', 63);
	memset(text + 66, ']', 63);
	assert_int_equal(parse(fixture, text), JN_OK); // the mapping and 63 lists
	memset(text + 3, '[', 64);
	memset(text + 67, ']', 64);
	expect_refusal(fixture, text, "a.yaml:1:67: nested too deeply");
}

static void more_than_a_million_nodes_are_refused(void** state) {
	Fixture* fixture = *state;
	const size_t count = JN_NODE_COUNT_LIMIT;
	char* text = calloc(2 * count + 16, 1);
	assert_non_null(text);
	strcpy(text, "a: [");
	for (size_t i = 0; i < count; i++) memcpy(text + 4 + 2 * i, "1,", 2);
	strcpy(text + 4 + 2 * count, "]");
	const JnStatus status = parse(fixture, text);
	free(text);
	assert_int_equal(status, JN_BAD_INPUT);
	expect_message(fixture, "more than 1000000 values");
}

static void write_file(const char* path, const char* bytes, size_t length) {
	FILE* file = fopen(path, "wb");
	assert_non_null(file);
	assert_int_equal(fwrite(bytes, 1, length, file), length);
	fclose(file);
}

static void files_are_read_or_refused_by_name(void** state) {
	Fixture* fixture = *state;
	char path[64] = "/tmp/jounce_document_XXXXXX";
	const int descriptor = mkstemp(path);
	assert_true(descriptor >= 0);
	close(descriptor);
	write_file(path, "a: 1\n", 5);
	assert_int_equal(jn_document_read(path, &fixture->arena, &fixture->document), JN_OK);
	assert_string_equal(fixture->document.text, "a: 1\n");
	assert_string_equal(fixture->document.path, path);
	write_file(path, "a\0b: 1\n", 7);
	assert_int_equal(jn_document_read(path, &fixture->arena, &fixture->document), JN_BAD_INPUT);
	expect_message(fixture, "zero bytes");
	assert_int_equal(truncate(path, (64 << 20) + 1), 0);
	assert_int_equal(jn_document_read(path, &fixture->arena, &fixture->document), JN_BAD_INPUT);
	expect_message(fixture, "larger than 64 MiB");
	unlink(path);
	assert_int_equal(jn_document_read(path, &fixture->arena, &fixture->document), JN_IO_FAILED);
	expect_message(fixture, "cannot be opened: No such file");
	assert_int_equal(jn_document_read("/tmp", &fixture->arena, &fixture->document), JN_IO_FAILED);
	expect_message(fixture, "/tmp: cannot be read: Is a directory");
}

static const char scene[] = "step: {dt: 1 ms}\nintegrator: sdirk2\ncontact: null\nbodies:\n  - name: a\n    x: 1\n";

static void override_replaces_a_value(void** state) {
	Fixture* fixture = *state;
	assert_int_equal(parse(fixture, scene), JN_OK);
	assert_int_equal(jn_document_set(&fixture->document, "step.dt=33ms"), JN_OK);
	assert_int_equal(jn_document_set(&fixture->document, "bodies[0].x=[0, 0, 1]"), JN_OK);
	assert_int_equal(jn_document_set(&fixture->document, "integrator=tr_bdf2"), JN_OK);
	const JnNode* root = fixture->document.root;
	const JnNode* dt = entry(entry(root, "step"), "dt");
	assert_string_equal(dt->scalar, "33ms");
	assert_string_equal(dt->source, "--set step.dt=33ms");
	assert_int_equal(dt->line, 0);
	assert_string_equal(entry(root, "integrator")->scalar, "tr_bdf2");
	assert_int_equal(entry(entry(root, "bodies")->children[0], "x")->count, 3);
	assert_int_equal(root->count, 4);
}

static void override_adds_what_is_missing(void** state) {
	Fixture* fixture = *state;
	assert_int_equal(parse(fixture, scene), JN_OK);
	assert_int_equal(jn_document_set(&fixture->document, "record.file.name=out.h5"), JN_OK);
	assert_int_equal(jn_document_set(&fixture->document, "bodies[1].name=b"), JN_OK);
	assert_int_equal(jn_document_set(&fixture->document, "contact.stiffness=5"), JN_OK);
	assert_int_equal(jn_document_set(&fixture->document, "loads[0]={kind: wind}"), JN_OK);
	const JnNode* root = fixture->document.root;
	assert_string_equal(entry(entry(entry(root, "record"), "file"), "name")->scalar, "out.h5");
	assert_int_equal(entry(root, "bodies")->count, 2);
	assert_string_equal(entry(entry(root, "bodies")->children[1], "name")->scalar, "b");
	assert_string_equal(entry(entry(root, "contact"), "stiffness")->scalar, "5");
	assert_string_equal(entry(entry(root, "loads")->children[0], "kind")->scalar, "wind");
}

static void expect_bad_override(Fixture* fixture, const char* assignment, const char* part) {
	assert_int_equal(parse(fixture, scene), JN_OK);
	assert_int_equal(jn_document_set(&fixture->document, assignment), JN_BAD_INPUT);
	expect_message(fixture, part);
}

static void bad_overrides_are_refused(void** state) {
	Fixture* fixture = *state;
	expect_bad_override(fixture, "step.dt", "--set step.dt: write path=value");
	expect_bad_override(fixture, "=3", "write path=value");
	expect_bad_override(fixture, "step.dt=", "the value is missing");
	expect_bad_override(fixture, "step..dt=3", "--set step..dt=3: the path is broken at '..dt'");
	expect_bad_override(fixture, "[0]=3", "the path is broken at '[0]");
	expect_bad_override(fixture, "bodies[x].y=3", "the path is broken at '[x]");
	expect_bad_override(fixture, "bodies[-1].y=3", "the path is broken at");
	expect_bad_override(fixture, "bodies[0]y=3", "the path is broken at 'y'");
	expect_bad_override(fixture, "step.=3", "the path is broken at");
	expect_bad_override(fixture, "bodies[2].x=3", "there is no entry [2] in a list of 1; [1] would add one");
	expect_bad_override(fixture, "bodies.x=3", "'bodies' is a list; choose an entry, such as bodies[0]");
	expect_bad_override(fixture, "step[0]=3", "'step' is a mapping and no list, so it has no [0]");
	expect_bad_override(fixture, "integrator[0]=3",
						"'integrator' is the single value 'sdirk2' (a.yaml:2:1) and no list");
	expect_bad_override(fixture, "step.dt=[1", "--set step.dt=[1: the YAML is broken");
	expect_bad_override(fixture, "step={a: 1, a: 2}", "the key 'a' is given twice");
}

static void override_below_a_single_word_says_how_to_write_it(void** state) {
	Fixture* fixture = *state;
	expect_bad_override(fixture, "integrator.method=tr_bdf2", "'integrator' is the single value 'sdirk2' (a.yaml:2:1)");
	expect_message(fixture, "--set 'integrator={method: value}'");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void) {
	const struct CMUnitTest tests[] = {
		TEST(tree_holds_kinds_texts_and_places),
		TEST(long_lists_keep_their_order),
		TEST(a_byte_order_mark_is_skipped),
		TEST(bad_yaml_is_refused_with_its_place),
		TEST(duplicate_keys_are_refused),
		TEST(unsupported_yaml_is_refused),
		TEST(root_must_be_a_mapping),
		TEST(depth_ends_at_64_levels),
		TEST(more_than_a_million_nodes_are_refused),
		TEST(files_are_read_or_refused_by_name),
		TEST(override_replaces_a_value),
		TEST(override_adds_what_is_missing),
		TEST(bad_overrides_are_refused),
		TEST(override_below_a_single_word_says_how_to_write_it),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
