// Scenes: which of their keys differ between the runs, and their texts.
#include <stdio.h>
#include <string.h>

#include "base/document.h"
#include "base/log.h"
#include "report_page.h"

enum { MOST_ENTRIES = 4000, MOST_ROWS = 100, PATH_BYTES = 256, VALUE_BYTES = 512 };

typedef struct Entry {
	const char *path, *value;
} Entry;

typedef struct Scene {
	int count;
	Entry* entries;
} Scene;

// ---- a scene as a list of paths and values ----

static void print_value(FILE* out, const JnNode* node) {
	if (node->kind == JN_NODE_SCALAR) {
		fputs(node->scalar, out);
		return;
	}
	for (int i = 0; i < node->count; ++i) {
		fputs(i > 0 ? ", " : "[", out);
		print_value(out, node->children[i]);
	}
	fputs("]", out);
}

static bool is_simple_list(const JnNode* node) {
	for (int i = 0; i < node->count; ++i)
		if (node->children[i]->kind == JN_NODE_MAPPING) return false;
	return node->kind == JN_NODE_SEQUENCE;
}

static void add(JnArena* arena, const char* path, const JnNode* node, Scene* scene) {
	char value[VALUE_BYTES] = "";
	FILE* out = fmemopen(value, sizeof value - 1, "w");
	if (out == NULL || scene->count == MOST_ENTRIES) return;
	print_value(out, node);
	fclose(out);
	scene->entries[scene->count++] = (Entry){jn_arena_text(arena, path), jn_arena_text(arena, value)};
}

static void flatten(JnArena* arena, const char* path, const JnNode* node, Scene* scene) {
	if (node->kind == JN_NODE_SCALAR || is_simple_list(node)) {
		add(arena, path, node, scene);
		return;
	}
	for (int i = 0; i < node->count; ++i) {
		char below[PATH_BYTES];
		const JnNode* child = node->children[i];
		if (node->kind == JN_NODE_MAPPING)
			snprintf(below, sizeof below, "%s%s%s", path, *path != '\0' ? "." : "", child->name);
		else
			snprintf(below, sizeof below, "%s[%d]", path, i);
		flatten(arena, below, child, scene);
	}
}

// Overrides stand as comments behind the text of the file.
static void apply_sets(JnDocument* document, JnArena* arena, const char* text) {
	static const char mark[] = "# --set ";
	for (const char* line = text; *line != '\0';) {
		const size_t length = strcspn(line, "\n");
		char set[1024];
		if (strncmp(line, mark, sizeof mark - 1) == 0 && length < sizeof set) {
			snprintf(set, sizeof set, "%.*s", (int)(length - sizeof mark + 1), line + sizeof mark - 1);
			jn_document_set(document, jn_arena_text(arena, set));
		}
		line += length + (line[length] == '\n');
	}
}

static void read_scene(JnArena* arena, const char* text, Scene* scene) {
	JnDocument document;
	*scene = (Scene){.entries = jn_arena_take(arena, MOST_ENTRIES, sizeof(Entry))};
	if (scene->entries == NULL || jn_document_parse("scene", text, arena, &document) != JN_OK) return;
	apply_sets(&document, arena, text);
	flatten(arena, "", document.root, scene);
}

static const char* value_at(const Scene* scene, const char* path) {
	for (int i = 0; i < scene->count; ++i)
		if (strcmp(scene->entries[i].path, path) == 0) return scene->entries[i].value;
	return NULL;
}

// ---- differences ----

static bool differs(int count, const Scene* scenes, const char* path) {
	const char* first = value_at(&scenes[0], path);
	for (int i = 1; i < count; ++i) {
		const char* other = value_at(&scenes[i], path);
		if ((first == NULL) != (other == NULL) || (first != NULL && strcmp(first, other) != 0)) return true;
	}
	return false;
}

// Was the path met in a scene before this one?
static bool is_known(int before, const Scene* scenes, const char* path) {
	for (int i = 0; i < before; ++i)
		if (value_at(&scenes[i], path) != NULL) return true;
	return false;
}

static void print_row(Report* report, const Scene* scenes, const char* path) {
	jn_text_print(&report->file, "<tr><th scope=\"row\"><code>");
	report_text(report, path);
	jn_text_print(&report->file, "</code></th>");
	for (int i = 0; i < report->count; ++i) {
		const char* value = value_at(&scenes[i], path);
		jn_text_print(&report->file, "<td>");
		report_text(report, value != NULL ? value : "–");
		jn_text_print(&report->file, "</td>");
	}
	jn_text_print(&report->file, "</tr>\n");
}

static int print_rows(Report* report, const Scene* scenes) {
	int rows = 0;
	for (int s = 0; s < report->count; ++s)
		for (int i = 0; i < scenes[s].count && rows < MOST_ROWS; ++i) {
			const char* path = scenes[s].entries[i].path;
			if (is_known(s, scenes, path) || !differs(report->count, scenes, path)) continue;
			print_row(report, scenes, path);
			++rows;
		}
	return rows;
}

static void keep_silent(void* user, JnLogLevel level, const char* message) {
	(void)user, (void)level, (void)message;
}

void report_differences(Report* report) {
	Scene scenes[REPORT_MOST_RUNS] = {0};
	if (report->count < 2) return;
	const JnLog log = jn_log_swap((JnLog){keep_silent, NULL}); // what cannot be parsed has no keys
	for (int i = 0; i < report->count; ++i)
		read_scene(&report->arena, report->sources->list[i].run.recording.scene_text, &scenes[i]);
	jn_log_swap(log);
	jn_text_print(&report->file,
				  "<section><h2>What differs between the scenes</h2><div class=\"wide\"><table><thead><tr><td></td>");
	for (int i = 0; i < report->count; ++i) {
		jn_text_print(&report->file, "<th scope=\"col\">");
		report_text(report, report->names[i]);
		jn_text_print(&report->file, "</th>");
	}
	jn_text_print(&report->file, "</tr></thead><tbody>\n");
	const int rows = print_rows(report, scenes);
	jn_text_print(&report->file, "</tbody></table></div>");
	if (rows == 0) jn_text_print(&report->file, "<p>Nothing: all keys are the same.</p>");
	if (rows == MOST_ROWS) jn_text_print(&report->file, "<p>And more: these are the first %d.</p>", MOST_ROWS);
	if (rows > 0) jn_text_print(&report->file, "<p class=\"faint\">–: not given, so that the default holds.</p>");
	jn_text_print(&report->file, "</section>\n");
}

// ---- texts ----

static bool is_first_with_text(const Report* report, int run) {
	for (int i = 0; i < run; ++i)
		if (strcmp(report->sources->list[i].run.recording.scene_text,
				   report->sources->list[run].run.recording.scene_text) == 0)
			return false;
	return true;
}

void report_scenes(Report* report) {
	jn_text_print(&report->file, "<section><h2>Scene</h2>\n");
	for (int i = 0; i < report->count; ++i) {
		const Recording* recording = &report->sources->list[i].run.recording;
		if (!is_first_with_text(report, i)) continue;
		jn_text_print(&report->file, "<details%s><summary>", report->count == 1 ? " open" : "");
		report_text(report, report->names[i]);
		jn_text_print(&report->file, ": ");
		report_text(report, recording->scene_path);
		jn_text_print(&report->file, "</summary><pre>");
		report_text(report, recording->scene_text);
		jn_text_print(&report->file, "</pre></details>\n");
	}
	jn_text_print(&report->file, "</section>\n");
}
