// Facts of the runs side by side, how far their ends are apart, and where the time went.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare_recording.h"
#include "report_page.h"

enum { NAME_BYTES = 80, MOST_PHASES = 16 };

static const char* const phase_colours[] = {"#3b82d6", "#e07b39", "#2f9e6e", "#b65fb0",
											"#c9a21f", "#6d68cf", "#2aa3b3", "#d2574d"};

static const struct {
	const char *name, *label, *unit;
} rows[] = {
	{"specific_error", "Energy error at the end", "J/kg"},
	{"specific_error_max", "Largest energy error", "J/kg"},
	{"steps", "Steps", ""},
	{"rejected", "Rejected steps", ""},
	{"newton", "Newton iterations", ""},
	{"factorizations", "Factorisations", ""},
	{"solves", "Solves", ""},
	{"iterations", "Iterations of linear solvers", ""},
	{"forces", "Force evaluations", ""},
	{"tangents", "Tangents", ""},
	{"indefinite", "Indefinite matrices", ""},
	{"wall_seconds", "Stepping", "s"},
	{"setup_seconds", "Setting up", "s"},
	{"wall_seconds_per_simulated_second", "Wall time a simulated second", "s"},
	{"threads", "Threads", ""},
	{"simd_width", "Elements at once", ""},
};

double report_number(const Report* report, int run, const char* name) {
	const char* summary = report->sources->list[run].run.summary;
	return summary != NULL ? compare_summary_number(summary, name) : NAN;
}

// ---- the table ----

static void print_number(Report* report, double value, const char* unit) {
	if (!isfinite(value))
		jn_text_print(&report->file, "<td>–</td>");
	else if (value == floor(value) && fabs(value) < 1e9)
		jn_text_print(&report->file, "<td>%.0f%s%s</td>", value, *unit != '\0' ? " " : "", unit);
	else
		jn_text_print(&report->file, "<td>%.4g%s%s</td>", value, *unit != '\0' ? " " : "", unit);
}

static void print_head(Report* report, const char* label) {
	jn_text_print(&report->file, "<tr><th scope=\"row\">%s</th>", label);
}

static void print_words(Report* report, const char* label, const char* (*words)(const ViewRun* run)) {
	print_head(report, label);
	for (int i = 0; i < report->count; ++i) {
		const char* text = words(&report->sources->list[i].run);
		jn_text_print(&report->file, "<td>");
		report_text(report, text != NULL ? text : "–");
		jn_text_print(&report->file, "</td>");
	}
	jn_text_print(&report->file, "</tr>\n");
}

static void print_numbers(Report* report, const char* label, const char* unit,
						  double (*number)(Report* report, int run)) {
	print_head(report, label);
	for (int i = 0; i < report->count; ++i) print_number(report, number(report, i), unit);
	jn_text_print(&report->file, "</tr>\n");
}

static const char* outcome_of(const ViewRun* run) {
	return run->recording.outcome;
}

static const char* method_of(const ViewRun* run) {
	return run->recording.method;
}

static const char* host_of(const ViewRun* run) {
	return run->recording.host;
}

static const char* version_of(const ViewRun* run) {
	return run->recording.version;
}

static const char* created_of(const ViewRun* run) {
	return run->recording.created;
}

static double last_time(Report* report, int run) {
	const ViewRun* it = &report->sources->list[run].run;
	return it->times[it->frame_count - 1];
}

static double frames_of(Report* report, int run) {
	return (double)report->sources->list[run].run.frame_count;
}

static double nodes_of(Report* report, int run) {
	return report->sources->list[run].run.recording.node_count;
}

static double cells_of(Report* report, int run) {
	const ViewRun* it = &report->sources->list[run].run;
	double cells = 0;
	for (int b = 0; b < it->body_count; ++b) cells += it->bodies[b].cell_count;
	return cells;
}

static double mass_of(Report* report, int run) {
	return report->sources->list[run].run.recording.total_mass;
}

// Root mean square of the distances of the drawn points in the last frame from those of the first run, when both are of
// one mesh and one time.
static double distance_of(Report* report, int run) {
	ViewRun *a = &report->sources->list[0].run, *b = &report->sources->list[run].run;
	const double slack = 1e-9 * fabs(last_time(report, 0));
	const size_t length = 3 * (size_t)a->points.count;
	double sum = 0;
	if (run == 0) return 0;
	if (a->points.count != b->points.count || fabs(last_time(report, 0) - last_time(report, run)) > slack) return NAN;
	float* numbers = malloc((2 * length + 1) * sizeof *numbers);
	const bool is_read = numbers != NULL && view_run_positions(a, a->frame_count - 1, numbers) == JN_OK &&
						 view_run_positions(b, b->frame_count - 1, numbers + length) == JN_OK;
	for (size_t i = 0; i < length && is_read; ++i)
		sum += ((double)numbers[i] - numbers[length + i]) * ((double)numbers[i] - numbers[length + i]);
	free(numbers);
	return is_read && a->points.count > 0 ? sqrt(sum / a->points.count) : NAN;
}

static void print_row(Report* report, size_t row) {
	bool is_known = false;
	for (int i = 0; i < report->count; ++i) is_known |= isfinite(report_number(report, i, rows[row].name));
	if (!is_known) return;
	print_head(report, rows[row].label);
	for (int i = 0; i < report->count; ++i)
		print_number(report, report_number(report, i, rows[row].name), rows[row].unit);
	jn_text_print(&report->file, "</tr>\n");
}

static void print_table(Report* report) {
	jn_text_print(&report->file, "<div class=\"wide\"><table><thead><tr><td></td>");
	for (int i = 0; i < report->count; ++i) {
		jn_text_print(&report->file, "<th scope=\"col\">");
		report_text(report, report->names[i]);
		jn_text_print(&report->file, "</th>");
	}
	jn_text_print(&report->file, "</tr></thead><tbody>\n");
	print_words(report, "Outcome", outcome_of);
	print_words(report, "Method", method_of);
	print_numbers(report, "Simulated time", "s", last_time);
	print_numbers(report, "Frames", "", frames_of);
	print_numbers(report, "Nodes", "", nodes_of);
	print_numbers(report, "Cells", "", cells_of);
	print_numbers(report, "Mass", "kg", mass_of);
	if (report->count > 1) print_numbers(report, "Distance of the end from the first run's", "m", distance_of);
	for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) print_row(report, i);
	print_words(report, "jounce", version_of);
	print_words(report, "Machine", host_of);
	print_words(report, "Started", created_of);
	jn_text_print(&report->file, "</tbody></table></div>\n");
}

// ---- where the time went ----

typedef struct Phase {
	char name[NAME_BYTES];
	double seconds;
} Phase;

static void add_phase(Phase* phases, int* count, const char* name, double seconds) {
	if (*count == MOST_PHASES || !(seconds > 0)) return;
	snprintf(phases[*count].name, NAME_BYTES, "%s", name);
	phases[(*count)++].seconds = seconds;
}

// What a phase is called in summary.json, for people.
static const char* label_of(const char* name) {
	static const char* const labels[][2] = {
		{"predict", "free motion"}, {"detect", "detection"}, {"factor", "contact factors"}, {"qp", "contact solver"}};
	for (size_t i = 0; i < sizeof labels / sizeof *labels; ++i)
		if (strcmp(labels[i][0], name) == 0) return labels[i][1];
	return name;
}

// All entries "seconds_<phase>" of summary.json, setting up, and what of the stepping is in none of them.
static int list_phases(const char* summary, Phase* phases) {
	static const char mark[] = "\"seconds_";
	double rest = compare_summary_number(summary, "wall_seconds");
	int count = 0;
	add_phase(phases, &count, "setting up", compare_summary_number(summary, "setup_seconds"));
	for (const char* at = summary; (at = strstr(at, mark)) != NULL;) {
		char entry[NAME_BYTES];
		at += 1;
		snprintf(entry, sizeof entry, "%.*s", (int)strcspn(at, "\""), at);
		const double seconds = compare_summary_number(summary, entry);
		add_phase(phases, &count, label_of(entry + sizeof mark - 2), seconds);
		if (isfinite(seconds)) rest -= seconds;
	}
	add_phase(phases, &count, "other", rest);
	return count;
}

static void print_bar(Report* report, const Phase* phases, int count, double longest) {
	const double width = 700;
	double left = 0;
	jn_text_print(&report->file, "<svg viewBox=\"0 0 700 18\" class=\"bar\" aria-hidden=\"true\">");
	for (int i = 0; i < count; ++i) {
		const double share = width * phases[i].seconds / longest;
		jn_text_print(&report->file, "<rect x=\"%.1f\" width=\"%.1f\" height=\"18\" fill=\"%s\"/>", left, share,
					  phase_colours[i % 8]);
		left += share;
	}
	jn_text_print(&report->file, "</svg>");
}

static void print_phases(Report* report, int run, double longest) {
	Phase phases[MOST_PHASES];
	const char* summary = report->sources->list[run].run.summary;
	const int count = summary != NULL ? list_phases(summary, phases) : 0;
	if (count == 0) return;
	jn_text_print(&report->file, "<p class=\"phases\">");
	if (report->count > 1) report_text(report, report->names[run]);
	print_bar(report, phases, count, longest);
	for (int i = 0; i < count; ++i) {
		jn_text_print(&report->file, "<span class=\"key\"><i style=\"background:%s\"></i> ", phase_colours[i % 8]);
		report_text(report, phases[i].name);
		jn_text_print(&report->file, " %.3g s</span> ", phases[i].seconds);
	}
	jn_text_print(&report->file, "</p>\n");
}

void report_statistics(Report* report) {
	double longest = 0;
	jn_text_print(&report->file, "<section><h2>Statistics</h2>\n");
	print_table(report);
	for (int i = 0; i < report->count; ++i)
		longest = fmax(longest, report_number(report, i, "wall_seconds") + report_number(report, i, "setup_seconds"));
	if (longest > 0) jn_text_print(&report->file, "<h3>Where the time went</h3>\n");
	for (int i = 0; i < report->count && longest > 0; ++i) print_phases(report, i, longest);
	jn_text_print(&report->file, "</section>\n");
}
