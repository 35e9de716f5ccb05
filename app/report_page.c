#include "report_page.h"

#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "interrupt.h"

static const char style[] =
	":root{color-scheme:light dark;--ground:#fff;--ink:#1b2430;--faint:#566171;--line:#d9dfe7;--raised:#f4f6f9}"
	"@media(prefers-color-scheme:dark){:root{--ground:#1b1f26;--ink:#e7ecf3;--faint:#a3afbf;--line:#38404c;--raised:"
	"#242a33}}*{box-sizing:border-box}body{font:15px/1.5 system-ui,\"Segoe UI\",Roboto,\"DejaVu Sans\",sans-serif;"
	"background:var(--ground);color:var(--ink);max-width:1240px;margin:0 auto;padding:1.5rem 1rem 4rem}"
	"h1{font-size:1.6rem;margin:0 0 .3rem}h2{font-size:1.15rem;margin:2.2rem 0 "
	".8rem;padding-bottom:.2rem;border-bottom:"
	"1px solid var(--line)}h3{font-size:1rem}.faint{color:var(--faint);margin:.2rem 0}figure{margin:0}"
	".warnings{border-left:4px solid #d2574d;background:var(--raised);padding:.6rem 1rem;margin:1rem 0}"
	".warnings p{margin:.2rem "
	"0;white-space:pre-wrap}.pictures,.charts{display:grid;gap:14px;grid-template-columns:repeat("
	"auto-fill,minmax(min(100%,380px),1fr))}.charts{grid-template-columns:repeat(auto-fill,minmax(min(100%,480px),1fr))"
	"}"
	".strips{display:grid;gap:10px}img{width:100%;height:auto;display:block;border-radius:6px}svg{width:100%;height:"
	"auto;"
	"display:block}svg text{font-size:11px;fill:var(--faint)}.grid{stroke:var(--line);fill:none}.curve{fill:none;"
	"stroke-width:1.6;stroke-linejoin:round}figcaption{font-size:13px;margin-bottom:4px}.key{white-space:nowrap;margin-"
	"left:"
	".6em;color:var(--faint);font-size:13px}.key svg{display:inline-block;width:22px}.key "
	"i{display:inline-block;width:10px;"
	"height:10px;border-radius:2px}.bar{max-width:760px;border-radius:4px;margin:.2rem 0}.phases{margin:.7rem 0}"
	".wide{overflow-x:auto}table{border-collapse:collapse;font-size:14px;font-variant-numeric:tabular-nums}th,td{text-"
	"align:"
	"left;font-weight:normal;padding:.25rem .9rem .25rem 0;border-bottom:1px solid var(--line);vertical-align:top}"
	"thead th{font-weight:600}tbody th{color:var(--faint)}pre{font:12px/1.5 ui-monospace,\"DejaVu Sans "
	"Mono\",monospace;"
	"background:var(--raised);padding:.8rem;border-radius:6px;overflow-x:auto}summary{cursor:pointer;margin:.5rem 0}";

void report_text(Report* report, const char* text) {
	for (; *text != '\0'; ++text)
		if (strchr("&<>\"'", *text) != NULL)
			jn_text_print(&report->file, "&#%d;", *text);
		else
			jn_text_write(&report->file, text, 1);
}

// ---- names ----

static const char* skip_folders(const char* path, int depth) {
	const char* at = path + strlen(path);
	while (at > path && at[-1] == '/') --at;
	for (; at > path; --at)
		if (at[-1] == '/' && depth-- == 0) break;
	return at;
}

static bool are_different(const ViewSources* sources, int depth) {
	for (int i = 0; i < sources->count; ++i)
		for (int j = 0; j < i; ++j)
			if (strcmp(skip_folders(sources->list[i].folder, depth), skip_folders(sources->list[j].folder, depth)) == 0)
				return false;
	return true;
}

// As many of the last folders as tell the runs apart.
static void name_runs(Report* report) {
	int depth = 0;
	while (depth < 6 && !are_different(report->sources, depth)) ++depth;
	for (int i = 0; i < report->count; ++i) report->names[i] = skip_folders(report->sources->list[i].folder, depth);
}

// ---- head ----

static void print_title(Report* report) {
	const char* before = NULL;
	if (report->options->title != NULL) {
		report_text(report, report->options->title);
		return;
	}
	for (int i = 0; i < report->count; ++i) {
		const char* name = report->sources->list[i].run.recording.scene_name;
		if (before != NULL && strcmp(name, before) == 0) continue;
		if (before != NULL) jn_text_print(&report->file, ", ");
		report_text(report, name);
		before = name;
	}
}

static void print_head(Report* report) {
	jn_text_print(&report->file,
				  "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
				  "content=\"width=device-width,initial-scale=1\"><link rel=\"icon\" href=\"data:,\"><title>");
	print_title(report);
	jn_text_print(&report->file, "</title><style>%s</style></head><body>\n<h1>", style);
	print_title(report);
	jn_text_print(&report->file, "</h1>\n");
	if (report->options->note != NULL) {
		jn_text_print(&report->file, "<p class=\"faint\">");
		report_text(report, report->options->note);
		jn_text_print(&report->file, "</p>\n");
	}
}

// ---- warnings ----

static bool is_done(const ViewRun* run) {
	return strcmp(run->recording.outcome, "done") == 0;
}

static void print_outcome(Report* report, int index) {
	const ViewRun* run = &report->sources->list[index].run;
	const bool is_unfinished = strcmp(run->recording.outcome, "running") == 0 && !view_run_is_running(run);
	jn_text_print(&report->file, "<p>");
	report_text(report, report->names[index]);
	jn_text_print(&report->file, ": %s",
				  is_unfinished ? "ended before its end, without a word" : run->recording.outcome);
	if (*run->recording.message != '\0') jn_text_print(&report->file, ": ");
	report_text(report, run->recording.message);
	jn_text_print(&report->file, "</p>\n");
}

static void print_warnings(Report* report) {
	bool has_any = report->no_pictures[0] != '\0';
	for (int i = 0; i < report->count; ++i) has_any |= !is_done(&report->sources->list[i].run);
	if (!has_any) return;
	jn_text_print(&report->file, "<div class=\"warnings\" role=\"note\">\n");
	for (int i = 0; i < report->count; ++i)
		if (!is_done(&report->sources->list[i].run)) print_outcome(report, i);
	if (report->no_pictures[0] != '\0') {
		jn_text_print(&report->file, "<p>No pictures: ");
		report_text(report, report->no_pictures);
		jn_text_print(&report->file, "</p>\n");
	}
	jn_text_print(&report->file, "</div>\n");
}

// ---- all ----

static JnStatus write_page(Report* report) {
	const char* path = report->options->output;
	const char* slash = strrchr(path, '/');
	char folder[JN_PATH_SIZE];
	snprintf(folder, sizeof folder, "%.*s",
			 slash == NULL   ? 1
			 : slash == path ? 1
							 : (int)(slash - path),
			 slash ? path : ".");
	JN_TRY(jn_text_open(&report->file, folder, slash != NULL ? slash + 1 : path, JN_TEXT_REPLACE));
	print_head(report);
	print_warnings(report);
	report_pictures(report);
	report_differences(report);
	report_curves(report);
	report_statistics(report);
	report_scenes(report);
	jn_text_print(&report->file, "</body></html>\n");
	return jn_text_close(&report->file);
}

static JnStatus read_series(Report* report) {
	for (int i = 0; i < report->count; ++i) {
		const JnStatus status = view_run_series(&report->sources->list[i].run, &report->series[i]);
		if (status == JN_BAD_INPUT) return status; // with its message
		if (status != JN_OK)
			return jn_error(status, "%s: its series cannot be read; is it being written?",
							report->sources->list[i].folder);
	}
	return JN_OK;
}

JnStatus report_write(const ReportOptions* options, ViewSources* sources) {
	const char* names[REPORT_MOST_RUNS];
	ViewSeries series[REPORT_MOST_RUNS] = {0};
	Report report = {.options = options, .sources = sources, .names = names, .series = series, .count = sources->count};
	name_runs(&report);
	JnStatus status = read_series(&report);
	if (status == JN_OK) report_pictures_make(&report);
	if (status == JN_OK && !app_interrupted) status = write_page(&report);
	for (int i = 0; i < report.count; ++i) jn_arena_free(&series[i].arena);
	jn_arena_free(&report.arena);
	free(report.pictures);
	return status;
}

JnStatus report_write_folders(const ReportOptions* options, int count, const char* const folders[], bool* is_written) {
	ViewSources sources = {.list = calloc(REPORT_MOST_RUNS, sizeof *sources.list)};
	if (sources.list == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the report's runs");
	for (int i = 0; i < count && sources.count < REPORT_MOST_RUNS; ++i) {
		ViewSource* source = &sources.list[sources.count];
		*source = (ViewSource){.folder = folders[i]};
		view_source_open(source);
		if (source->is_open && source->run.frame_count > 0)
			++sources.count;
		else
			view_run_close(&source->run);
	}
	const JnStatus status = sources.count > 0 ? report_write(options, &sources) : JN_OK;
	*is_written = status == JN_OK && sources.count > 0;
	for (int i = 0; i < sources.count; ++i) view_run_close(&sources.list[i].run);
	free(sources.list);
	return status;
}
