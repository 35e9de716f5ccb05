// Two writers of one content: HTML escapes what it must, Markdown stays as it is.
#include "reproduce/page.h"

#include <stdarg.h>
#include <string.h>
#include <unistd.h>

#include "record/host.h"

static const char style[] =
	"body{font:16px/1.55 system-ui,sans-serif;color:#222;max-width:1100px;margin:2rem auto;padding:0 1rem}"
	"h1{font-size:1.7rem}h2{font-size:1.2rem;margin-top:2rem;border-bottom:1px solid #ddd}"
	"table{border-collapse:collapse;margin:1rem 0;font-size:.9rem}td,th{padding:.25rem .7rem;border-bottom:1px solid "
	"#e4e4e4;text-align:right}td:first-child,th:first-child{text-align:left}th{border-bottom:2px solid #999}"
	"img{max-width:100%;height:auto}figure{margin:1.2rem 0}figcaption{color:#555;font-size:.9rem}"
	"pre{background:#f5f5f5;padding:.7rem;overflow-x:auto;font-size:.8rem}.overflow{overflow-x:auto}";

static void print_escaped(JnTextFile* file, const char* text) {
	for (const char* at = text; *at != '\0'; ++at) {
		const char* entity = *at == '&'   ? "&amp;"
							 : *at == '<' ? "&lt;"
							 : *at == '>' ? "&gt;"
							 : *at == '"' ? "&quot;"
										  : NULL;
		if (entity != NULL)
			jn_text_print(file, "%s", entity);
		else
			jn_text_write(file, at, 1);
	}
}

JnStatus page_open(Page* page, const char* folder, const char* name, const char* doc) {
	*page = (Page){0};
	JN_TRY(jn_text_open(&page->html, folder, "index.html", JN_TEXT_REPLACE));
	const JnStatus status = jn_text_open(&page->markdown, folder, "page.md", JN_TEXT_REPLACE);
	if (status != JN_OK) {
		jn_text_abandon(&page->html);
		return status;
	}
	jn_text_print(&page->html,
				  "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>%s</title>\n"
				  "<meta name=\"viewport\" content=\"width=device-width\"><style>%s</style></head><body>\n<h1>%s: ",
				  name, style, name);
	print_escaped(&page->html, doc);
	jn_text_print(&page->html, "</h1>\n");
	jn_text_print(&page->markdown, "# %s: %s\n", name, doc);
	return JN_OK;
}

void page_heading(Page* page, const char* text) {
	jn_text_print(&page->html, "<h2>");
	print_escaped(&page->html, text);
	jn_text_print(&page->html, "</h2>\n");
	jn_text_print(&page->markdown, "\n## %s\n", text);
}

void page_text(Page* page, const char* format, ...) {
	char text[4096];
	va_list values;
	va_start(values, format);
	vsnprintf(text, sizeof text, format, values);
	va_end(values);
	jn_text_print(&page->html, "<p>");
	print_escaped(&page->html, text);
	jn_text_print(&page->html, "</p>\n");
	jn_text_print(&page->markdown, "\n%s\n", text);
}

static bool is_beside(const Page* page, const char* file) {
	char path[JN_PATH_SIZE];
	const char* slash = strrchr(page->html.path, '/');
	const int length = slash != NULL ? (int)(slash - page->html.path) + 1 : 0;
	const int size = snprintf(path, sizeof path, "%.*s%s", length, page->html.path, file);
	return size < (int)sizeof path && access(path, R_OK) == 0;
}

void page_picture(Page* page, const char* file, const char* caption) {
	if (!is_beside(page, file)) {
		page_text(page, "(%s was not drawn.)", file);
		return;
	}
	jn_text_print(&page->html, "<figure><img src=\"%s\" alt=\"", file);
	print_escaped(&page->html, caption);
	jn_text_print(&page->html, "\"><figcaption>");
	print_escaped(&page->html, caption);
	jn_text_print(&page->html, "</figcaption></figure>\n");
	jn_text_print(&page->markdown, "\n![%s](%s)\n\n*%s*\n", caption, file, caption);
}

void page_link(Page* page, const char* file, const char* words) {
	jn_text_print(&page->html, "<p><a href=\"%s\">%s</a>: ", file, file);
	print_escaped(&page->html, words);
	jn_text_print(&page->html, "</p>\n");
	jn_text_print(&page->markdown, "\n[%s](%s): %s\n", file, file, words);
}

static void print_row(Page* page, const Table* table, int row) {
	const char* kind = row == 0 ? "th" : "td";
	jn_text_print(&page->html, "<tr>");
	jn_text_print(&page->markdown, "|");
	for (int i = 0; i < table->columns; ++i) {
		int length = 0;
		const char* cell = table_cell(table, row, i, &length);
		char text[512];
		snprintf(text, sizeof text, "%.*s", length, cell);
		jn_text_print(&page->html, "<%s>", kind);
		print_escaped(&page->html, text);
		jn_text_print(&page->html, "</%s>", kind);
		jn_text_print(&page->markdown, " %s |", text);
	}
	jn_text_print(&page->html, "</tr>\n");
	jn_text_print(&page->markdown, "\n");
}

void page_table(Page* page, const Table* table) {
	jn_text_print(&page->html, "<div class=\"overflow\"><table>\n");
	jn_text_print(&page->markdown, "\n");
	for (int row = 0; row < table->rows; ++row) {
		print_row(page, table, row);
		if (row > 0) continue;
		jn_text_print(&page->markdown, "|");
		for (int i = 0; i < table->columns; ++i) jn_text_print(&page->markdown, " %s |", i == 0 ? "---" : "---:");
		jn_text_print(&page->markdown, "\n");
	}
	jn_text_print(&page->html, "</table></div>\n");
}

static void print_command(Page* page, const CompareRun* run) {
	JnTextFile* files[] = {&page->html, &page->markdown};
	for (int f = 0; f < 2; ++f) {
		jn_text_print(files[f], "jounce run %s", run->scene);
		for (int i = 0; i < run->set_count; ++i)
			if (f == 0) {
				jn_text_print(files[f], " --set '");
				print_escaped(files[f], run->sets[i]);
				jn_text_print(files[f], "'");
			} else
				jn_text_print(files[f], " --set '%s'", run->sets[i]);
		jn_text_print(files[f], "\n");
	}
}

void page_runs(Page* page, const ComparePlan* plan, const CompareJobs* jobs) {
	enum { MOST_SHOWN = 20 };
	if (jobs->failed > 0 || jobs->done < plan->run_count) {
		page_heading(page, "Runs that are not done");
		for (int i = 0; i < plan->run_count; ++i) {
			const CompareJob* job = &jobs->list[i];
			if (job->state == COMPARE_FAILED) page_text(page, "%s failed: %s", plan->runs[i].label, job->message);
			if (job->state != COMPARE_FAILED && job->state != COMPARE_DONE)
				page_text(page, "%s: not run yet", plan->runs[i].label);
		}
	}
	page_heading(page, "Commands");
	if (plan->run_count > MOST_SHOWN)
		page_text(page, "The first %d of %d; settings.txt in each folder of runs/ has what belongs to it.", MOST_SHOWN,
				  plan->run_count);
	jn_text_print(&page->html, "<pre>");
	jn_text_print(&page->markdown, "\n```sh\n");
	for (int i = 0; i < plan->run_count && i < MOST_SHOWN; ++i) print_command(page, &plan->runs[i]);
	jn_text_print(&page->html, "</pre>\n");
	jn_text_print(&page->markdown, "```\n");
}

JnStatus page_close(Page* page, const CompareOptions* options) {
	const JnHost host = jn_host_describe();
	char now[32];
	jn_host_time(now);
	page_heading(page, "Machine");
	page_text(page, "%s, %d cores, %s; jounce %s, %d thread%s a run; %s.", host.processor, host.cores, host.system,
			  JN_VERSION, options->threads, options->threads == 1 ? "" : "s", now);
	jn_text_print(&page->html, "</body></html>\n");
	const JnStatus first = jn_text_close(&page->html), second = jn_text_close(&page->markdown);
	return first != JN_OK ? first : second;
}
