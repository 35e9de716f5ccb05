// jounce compare: run a scene for every combination of some keys' values, and put costs and errors into tables and plots.
//
//   options -> plan (the combinations) -> check (all scenes load) -> jobs (processes) -> results -> tables, plots
#include <stdio.h>

#include "app.h"
#include "base/folder.h"
#include "base/log.h"
#include "compare_check.h"
#include "compare_files.h"
#include "compare_jobs.h"
#include "compare_plots.h"
#include "compare_report.h"
#include "compare_tables.h"

static const char help[] =
	"usage: jounce compare SCENE --vary key=a,b,c [--vary key=...] [--reference key=value ...]\n"
	"                      [--set key=value ...] [-o DIR] [--jobs N] [--threads N] [--quiet]\n\n"
	"  --vary key=a,b,c       run every combination of these values: --vary integrator.method=sdirk2,backward_euler\n"
	"                         --vary step.dt=10ms,5ms; commas inside brackets belong to a value\n"
	"  --reference key=value  one more, fine run that errors are measured against: --reference step.dt=0.1ms; may be\n"
	"                         given several times, for all the keys that the reference sets\n"
	"  --set key=value        override a key in all runs\n"
	"  -o, --output DIR       where results go; default out/<name of the scene>_compare\n"
	"  --jobs N               runs at a time; default: as many as keep the processors busy\n"
	"  --threads N            of each run; default 1\n"
	"  -q, --quiet            no progress, no table\n\n"
	"Writes comparison.csv, comparison.md, comparison.txt, plots/, report.html and a folder for each run in runs/. "
	"The\n"
	"runs draw no plots of their own unless asked by --set record.plots=yes. Ctrl-C finishes the steps in progress and "
	"stops; the "
	"same\n"
	"command goes on from there, for runs that are done and whose settings are the same are kept.\n\n"
	"exit status: 0 all done, or stopped by Ctrl-C; 1 a run failed, the table says which; 2 bad input; 3 files";

static void print_start(const CompareOptions* options, const ComparePlan* plan, const CompareJobs* jobs) {
	if (options->is_quiet) return;
	printf("%s: %d run%s", options->scene, plan->run_count, plan->run_count == 1 ? "" : "s");
	if (jobs->kept > 0) printf(", %d of them done already", jobs->kept);
	if (jobs->kept < plan->run_count) printf(", %d at a time", jobs->limit);
	printf(", in %s\n", plan->directory);
	fflush(stdout);
}

static void print_end(const CompareJobs* jobs, const CompareResults* results, int plots, bool has_page) {
	const char* directory = results->plan->directory;
	putchar('\n');
	compare_table_print(results, stdout);
	if (results->plan->has_reference && !results->has_errors) puts("\nno errors: the reference is not done");
	if (jobs->was_stopped)
		printf("\nstopped as asked, with %d of %d runs done; the same command goes on from there\n", jobs->done,
			   results->plan->run_count);
	printf("\nwrote %s: comparison.txt, comparison.csv, comparison.md", directory);
	if (plots > 0) printf(", plots/ (%d picture%s)", plots, plots == 1 ? "" : "s");
	puts(has_page ? ", report.html, runs/" : ", runs/");
}

static JnStatus report(const CompareOptions* options, CompareJobs* jobs) {
	int plots = 0;
	bool has_page = false;
	CompareResults results;
	JnStatus status = compare_results_read(jobs, &results);
	if (status == JN_OK) status = compare_tables_write(&results);
	if (status == JN_OK) status = compare_plots_draw(&results, &plots);
	if (status == JN_OK) status = compare_report_write(results.plan->scene_name, jobs, &has_page);
	if (status == JN_OK && !options->is_quiet) print_end(jobs, &results, plots, has_page);
	compare_results_free(&results);
	fflush(stdout);
	clearerr(stdout); // what counts is on disk; a table that nobody reads is no failure
	return status;
}

static int run_plan(const CompareOptions* options, const ComparePlan* plan) {
	CompareJobs jobs;
	JnStatus status = jn_folder_make(plan->directory);
	if (status != JN_OK) return app_exit_status(status);
	status = compare_jobs_prepare(options, plan, &jobs);
	if (status == JN_OK) print_start(options, plan, &jobs);
	if (status == JN_OK) status = compare_jobs_run(&jobs);
	if (status == JN_OK) status = report(options, &jobs);
	const bool has_failures = jobs.failed > 0;
	compare_jobs_free(&jobs);
	if (status != JN_OK) return app_exit_status(status);
	return has_failures ? EXIT_RUN_FAILED : EXIT_DONE;
}

static int compare(const CompareOptions* options) {
	ComparePlan plan;
	int status = compare_plan_create(options, &plan);
	if (status == EXIT_DONE) status = compare_plan_check(options, &plan);
	if (status == EXIT_DONE) status = run_plan(options, &plan);
	compare_plan_free(&plan);
	return status;
}

int app_compare(int count, char** arguments) {
	CompareOptions options;
	int status = compare_options_read(count, arguments, &options);
	if (status == EXIT_DONE && options.wants_help)
		puts(help);
	else if (status == EXIT_DONE)
		status = compare(&options);
	compare_options_free(&options);
	return status;
}
