// The results as aligned text, as Markdown and as CSV, from one list of columns.
#include <math.h>
#include <string.h>

#include "base/log.h"
#include "record/host.h"
#include "record/text_file.h"
#include "score.h"

enum { CELL_SIZE = 64 };

/// A column: its value of a method, or NAN.
typedef struct Column {
	const char* name;   // in the CSV
	const char* title;  // for people; NULL: not shown to them
	const char* format; // for people
	double scale;       // of the value, for people
	double (*value)(const Score*, const ScoreMethod*);
} Column;

static double order(const Score* score, const ScoreMethod* method) {
	(void)score;
	return method->type->order;
}

static double limit(const Score* score, const ScoreMethod* method) {
	(void)score;
	return method->limit;
}

static double seconds(const Score* score, const ScoreMethod* method) {
	(void)score;
	return method->seconds;
}

static double forces(const Score* score, const ScoreMethod* method) {
	(void)score;
	return method->forces;
}

static double error_half(const Score* score, const ScoreMethod* method) {
	(void)score;
	return method->error_half;
}

static double error_scene(const Score* score, const ScoreMethod* method) {
	(void)score;
	return method->error_scene;
}

static double runs(const Score* score, const ScoreMethod* method) {
	(void)score;
	return method->runs;
}

static double is_capped(const Score* score, const ScoreMethod* method) {
	(void)score;
	return method->is_capped;
}

static const Column columns[] = {
	{"order", "order", "%.0f", 1, order},
	{"limit_s", "largest stable step [ms]", "%.4g", 1e3, limit},
	{"is_capped", NULL, NULL, 1, is_capped},
	{"step_s", "time of a step [us]", "%.3g", 1e6, seconds},
	{"forces", "forces a step", "%.3g", 1, forces},
	{"score", "score", "%.3g", 1, score_value},
	{"score_by_forces", "score by forces", "%.3g", 1, score_by_forces},
	{"energy_error_half_limit", "energy error at half that step", "%+.1e", 1, error_half},
	{"energy_error_scene_step", "energy error at the scene's step", "%+.1e", 1, error_scene},
	{"runs", NULL, NULL, 1, runs},
};
enum { COLUMNS = sizeof columns / sizeof *columns };

static bool is_limit(const Column* column) {
	return column->value == limit;
}

static void format_cell(const Score* score, const ScoreMethod* method, const Column* column, char out[CELL_SIZE]) {
	const double value = column->value(score, method);
	char number[CELL_SIZE / 2];
	snprintf(out, CELL_SIZE, "-");
	if (!isfinite(value)) return;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
	snprintf(number, sizeof number, column->format, column->scale * value);
#pragma GCC diagnostic pop
	if (is_limit(column) && value == 0)
		snprintf(out, CELL_SIZE, "none");
	else
		snprintf(out, CELL_SIZE, "%s%s", is_limit(column) && method->is_capped ? ">= " : "", number);
}

// ---- text ----

static int width_of(const Score* score, const Column* column) {
	char cell[CELL_SIZE];
	size_t width = strlen(column->title);
	for (int i = 0; i < score->count; ++i) {
		format_cell(score, &score->list[i], column, cell);
		if (strlen(cell) > width) width = strlen(cell);
	}
	return (int)width;
}

static int name_width(const Score* score) {
	size_t width = strlen("method");
	for (int i = 0; i < score->count; ++i) {
		const size_t length = strlen(score->list[i].type->row.name);
		if (length > width) width = length;
	}
	return (int)width;
}

static void print_notes(const Score* score, FILE* out) {
	fprintf(
		out,
		"\nStable: |E(t) - E(0)| <= %g x %.4g J over %g s, E the total energy; that energy in motion is the range of "
		"the\nkinetic and of the potential energy together, by %s with steps of %.3g s. Steps up to %.4g s were "
		"tried.\nScore: largest stable step over the time of a step, relative to %s; by forces: over evaluations of "
		"forces.\nEnergy error: E at the end minus that of the reference, in energy in motion.\n",
		score->options->factor, score->scale, score->time, score->reference->row.name, score->reference_dt, score->cap,
		score->list[score->first].type->row.name);
}

void score_table_print(const Score* score, FILE* out) {
	const int first = name_width(score);
	fprintf(out, "%-*s", first, "method");
	for (int c = 0; c < COLUMNS; ++c)
		if (columns[c].title != NULL) fprintf(out, "  %*s", width_of(score, &columns[c]), columns[c].title);
	fputc('\n', out);
	for (int i = 0; i < score->count; ++i) {
		fprintf(out, "%-*s", first, score->list[i].type->row.name);
		for (int c = 0; c < COLUMNS; ++c) {
			char cell[CELL_SIZE];
			if (columns[c].title == NULL) continue;
			format_cell(score, &score->list[i], &columns[c], cell);
			fprintf(out, "  %*s", width_of(score, &columns[c]), cell);
		}
		fputc('\n', out);
	}
	print_notes(score, out);
}

// ---- files ----

static JnStatus write_text(const Score* score) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, score->directory, "score.txt", JN_TEXT_REPLACE));
	score_table_print(score, file.stream);
	return jn_text_close(&file);
}

static JnStatus write_csv(const Score* score) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, score->directory, "score.csv", JN_TEXT_REPLACE));
	jn_text_print(&file, "method");
	for (int c = 0; c < COLUMNS; ++c) jn_text_print(&file, ",%s", columns[c].name);
	for (int i = 0; i < score->count; ++i) {
		jn_text_print(&file, "\n%s", score->list[i].type->row.name);
		for (int c = 0; c < COLUMNS; ++c) {
			const double value = columns[c].value(score, &score->list[i]);
			jn_text_print(&file, isfinite(value) ? ",%.9g" : ",", value);
		}
	}
	jn_text_print(&file, "\n");
	return jn_text_close(&file);
}

static void print_machine(const Score* score, JnTextFile* file) {
	const JnHost host = jn_host_describe();
	char now[32];
	jn_host_time(now);
	jn_text_print(file, "\n%s, %d cores, %d thread%s a run; jounce %s, %s.\n", host.processor, host.cores,
				  score->options->threads, score->options->threads == 1 ? "" : "s", JN_VERSION, now);
}

static JnStatus write_markdown(const Score* score) {
	JnTextFile file;
	char cell[CELL_SIZE];
	JN_TRY(jn_text_open(&file, score->directory, "score.md", JN_TEXT_REPLACE));
	jn_text_print(&file, "# Scores on %s\n\n| method |", score->options->scene);
	for (int c = 0; c < COLUMNS; ++c)
		if (columns[c].title != NULL) jn_text_print(&file, " %s |", columns[c].title);
	jn_text_print(&file, "\n| --- |");
	for (int c = 0; c < COLUMNS; ++c)
		if (columns[c].title != NULL) jn_text_print(&file, " ---: |");
	for (int i = 0; i < score->count; ++i) {
		jn_text_print(&file, "\n| %s |", score->list[i].type->row.name);
		for (int c = 0; c < COLUMNS; ++c) {
			if (columns[c].title == NULL) continue;
			format_cell(score, &score->list[i], &columns[c], cell);
			jn_text_print(&file, " %s |", cell);
		}
	}
	jn_text_print(&file, "\n");
	print_notes(score, file.stream);
	print_machine(score, &file);
	return jn_text_close(&file);
}

JnStatus score_tables_write(const Score* score) {
	JN_TRY(write_csv(score));
	JN_TRY(write_markdown(score));
	return write_text(score);
}
