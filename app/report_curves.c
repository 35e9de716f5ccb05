// Which curves are drawn together. One run shows its parts; of several runs each is one curve.
#include <stdio.h>
#include <string.h>

#include "report_chart.h"
#include "report_page.h"

enum { MOST_PARTS = 4, MOST_PROBES = 12 };

typedef struct Plan {
	const char* title;
	const char* columns[MOST_PARTS]; // of one run
	const char* main;                // of several
	bool is_log;
} Plan;

static const Plan plans[] = {
	{"Energy", {"kinetic", "elastic", "gravity", "total"}, "total", false},
	{"Energy error", {"specific_error"}, "specific_error", true},
	{"Step size", {"dt"}, "dt", true},
	{"Newton iterations in a step", {"newton"}, "newton", false},
	{"Contacts", {"contacts"}, "contacts", false},
};

static const ViewColumn* find_column(const ViewSeries* series, const char* name) {
	for (int i = 0; name != NULL && i < series->count; ++i)
		if (strcmp(series->columns[i].name, name) == 0) return &series->columns[i];
	return NULL;
}

static void add(const ViewSeries* series, const char* column, const char* name, ReportChart* chart,
				ReportCurve* curves) {
	const ViewColumn *found = find_column(series, column), *time = find_column(series, "t");
	if (found == NULL || time == NULL) return;
	curves[chart->count++] = (ReportCurve){name, series->rows, time->values, found->values};
	chart->unit = found->unit;
}

static void draw(Report* report, const Plan* plan) {
	ReportCurve curves[REPORT_MOST_RUNS + MOST_PARTS];
	ReportChart chart = {.title = plan->title, .unit = "", .is_log = plan->is_log, .curves = curves};
	for (int i = 0; i < MOST_PARTS && report->count == 1; ++i)
		add(report->series, plan->columns[i], plan->columns[i], &chart, curves);
	for (int i = 0; i < report->count && report->count > 1; ++i)
		add(&report->series[i], plan->main, report->names[i], &chart, curves);
	report_chart_print(&report->file, &chart);
}

// A probe has three coordinates; of several runs the vertical one is compared.
static void draw_probe(Report* report, const char* column) {
	char title[128], names[3][96];
	Plan plan = {.title = title};
	const int length = (int)(strlen(column) - strlen("probe..x"));
	snprintf(title, sizeof title, "Probe %.*s%s", length, column + strlen("probe."), report->count > 1 ? ", y" : "");
	for (int i = 0; i < 3; ++i) {
		snprintf(names[i], sizeof names[i], "%.*s%c", (int)strlen(column) - 1, column, "xyz"[i]);
		plan.columns[i] = names[i];
	}
	plan.main = names[1];
	draw(report, &plan);
}

static bool is_probe(const char* column) {
	const size_t length = strlen(column);
	return strncmp(column, "probe.", 6) == 0 && length > 8 && strcmp(column + length - 2, ".x") == 0;
}

void report_curves(Report* report) {
	const ViewSeries* first = &report->series[0];
	jn_text_print(&report->file, "<section><h2>Over time</h2><div class=\"charts\">\n");
	for (size_t i = 0; i < sizeof plans / sizeof *plans; ++i) draw(report, &plans[i]);
	for (int i = 0, probes = 0; i < first->count && probes < MOST_PROBES; ++i) {
		if (!is_probe(first->columns[i].name)) continue;
		draw_probe(report, first->columns[i].name);
		++probes;
	}
	jn_text_print(&report->file, "</div></section>\n");
}
