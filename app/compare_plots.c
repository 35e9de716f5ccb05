// Each picture is a gnuplot script that reads plots/comparison.dat (one block a group, coarse to fine) or the series of
// the runs, and can be run again by hand.
#include "compare_plots.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/folder.h"
#include "base/log.h"
#include "compare_drawing.h"
#include "compare_script.h"

enum { MOST_TICKS = 10, MOST_KEYS = 60, PLOTTED_ROWS = 2000 };

// ---- data ----

static int coarse_first(const void* a, const void* b) {
	const CompareRun *first = *(const CompareRun*const*)a, *second = *(const CompareRun*const*)b;
	if (first->group != second->group) return first->group < second->group ? -1 : 1;
	if (first->dt != second->dt) return first->dt > second->dt ? -1 : 1;
	return (first > second) - (first < second);
}

static void print_datum(JnTextFile* file, double value) {
	if (value > 0 && isfinite(value))
		jn_text_print(file, " %.9g", value);
	else
		jn_text_print(file, " NaN"); // has no place on a logarithmic axis
}

static void print_blocks(JnTextFile* file, const CompareResults* results, const CompareRun** order, int count) {
	const ComparePlan* plan = results->plan;
	for (int i = 0; i < count; ++i) {
		const int run = (int)(order[i] - plan->runs);
		const bool begins = i == 0 || order[i]->group != order[i - 1]->group;
		if (begins) jn_text_print(file, "%s# %s\n", i > 0 ? "\n\n" : "", plan->groups[order[i]->group]);
		print_datum(file, order[i]->dt);
		print_datum(file, compare_result_error(results, run));
		print_datum(file, results->list[run].factorizations);
		print_datum(file, results->list[run].wall_seconds);
		jn_text_print(file, "\n");
	}
}

static JnStatus write_data(const CompareResults* results, const char* folder) {
	const ComparePlan* plan = results->plan;
	const int count = plan->run_count - plan->has_reference;
	const CompareRun** order = calloc((size_t)count, sizeof *order);
	if (order == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the plots' data");
	for (int i = 0; i < count; ++i) order[i] = &plan->runs[i];
	qsort(order, (size_t)count, sizeof *order, coarse_first);
	JnTextFile file;
	JnStatus status = jn_text_open(&file, folder, "comparison.dat", JN_TEXT_REPLACE);
	if (status == JN_OK) {
		jn_text_print(&file, "# step.dt [s], %s, factorisations, wall time [s]\n", compare_error_words(results));
		print_blocks(&file, results, order, count);
		status = jn_text_close(&file);
	}
	free(order);
	return status;
}

// ---- convergence: error over step, both logarithmic ----

// The steps themselves are the marks, in ms unless they are long.
static void print_step_axis(JnTextFile* file, const ComparePlan* plan) {
	double low = INFINITY, high = 0;
	for (int i = 0; i < plan->run_count; ++i) {
		if (!(plan->runs[i].dt > 0)) continue;
		low = fmin(low, plan->runs[i].dt);
		high = fmax(high, plan->runs[i].dt);
	}
	const bool in_ms = high < 0.5;
	jn_text_print(file, "set logscale xy\nset xlabel 'time step [%s]'\nset xrange [%g:%g]\n", in_ms ? "ms" : "s",
				  low / 1.25, high * 1.25);
	const CompareKey* key = &plan->keys[plan->dt_key];
	if (key->count > MOST_TICKS) return;
	const char* lead = "set xtics (";
	for (int i = 0; i < plan->run_count - plan->has_reference; ++i) {
		if (plan->runs[i].group != 0) continue;
		jn_text_print(file, "%s'%.4g' %.9g", lead, plan->runs[i].dt * (in_ms ? 1e3 : 1), plan->runs[i].dt);
		lead = ", ";
	}
	jn_text_print(file, ")\n");
}

static JnStatus write_convergence(const CompareResults* results, const char* folder) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, folder, "convergence.gnuplot", JN_TEXT_REPLACE));
	compare_print_style(&file, "convergence", "Error over time step, with slopes fitted by least squares");
	jn_text_print(&file, "set title ");
	compare_print_title(&file, results, "convergence");
	jn_text_print(&file, "\nset ylabel '%s'\nset format y '10^{%%T}'\n", compare_error_words(results));
	print_step_axis(&file, results->plan);
	jn_text_print(&file, "set key outside right top vertical reverse Left samplen 2 spacing 1.2 font ',12'\n");
	compare_print_terminal(&file, "convergence", "svg", 900, 500);
	compare_print_groups(&file, results, 1, COMPARE_NAMES_AND_SLOPES);
	compare_print_terminal(&file, "convergence", "png", 900, 500);
	jn_text_print(&file, "replot\n");
	return jn_text_close(&file);
}

// ---- energy error over time ----

// With one group colours tell the steps apart; with several they tell the groups, and dashes the steps.
static void print_run_pen(JnTextFile* file, const CompareResults* results, int run) {
	const ComparePlan* plan = results->plan;
	int rank = 0; // 0: the finest step
	if (plan->runs[run].is_reference) {
		jn_text_print(file, "lw 1.2 dt 3 lc rgb '#808080'");
		return;
	}
	for (int i = 0; i < plan->run_count; ++i)
		rank += plan->runs[i].group == plan->runs[run].group && plan->runs[i].dt < plan->runs[run].dt;
	if (plan->group_count == 1)
		compare_print_pen(file, rank, rank / COMPARE_COLOURS);
	else
		compare_print_pen(file, plan->runs[run].group, rank + plan->runs[run].group / COMPARE_COLOURS);
}

static int energy_curves(const CompareResults* results) {
	int count = 0;
	for (int i = 0; i < results->plan->run_count; ++i)
		count += results->jobs->list[i].state == COMPARE_DONE && results->list[i].energy_max > 0;
	return count;
}

static void print_energy_curves(JnTextFile* file, const CompareResults* results) {
	const char* lead = "plot";
	for (int i = 0; i < results->plan->run_count; ++i) {
		const CompareResult* result = &results->list[i];
		const CompareRun* run = &results->plan->runs[i];
		const int stride = 1 + (int)fmin(result->steps / PLOTTED_ROWS, 1e6);
		if (results->jobs->list[i].state != COMPARE_DONE || !(result->energy_max > 0)) continue;
		jn_text_print(file, "%s '../runs/", lead);
		compare_print_quoted(file, run->name);
		jn_text_print(file, "/series.csv' every %d using (column('t')):(shown(column('specific_error'))) with lines ",
					  stride);
		print_run_pen(file, results, i);
		jn_text_print(file, " title '");
		compare_print_quoted(file, run->label);
		jn_text_print(file, "' noenhanced");
		lead = ", \\\n    ";
	}
	jn_text_print(file, "\n");
}

static double largest_energy_error(const CompareResults* results) {
	double largest = 0;
	for (int i = 0; i < results->plan->run_count; ++i) largest = fmax(largest, results->list[i].energy_max);
	return largest;
}

static JnStatus write_energy(const CompareResults* results, const char* folder) {
	JnTextFile file;
	const int curves = energy_curves(results);
	JN_TRY(jn_text_open(&file, folder, "energy.gnuplot", JN_TEXT_REPLACE));
	compare_print_style(&file, "energy", "Distance of the specific total energy from its start");
	jn_text_print(&file, "set title ");
	compare_print_title(&file, results, "energy error over time");
	jn_text_print(&file,
				  "\nset datafile separator comma\n"
				  "set xlabel 'time [s]'\nset ylabel 'energy error [J/kg]'\n"
				  "set logscale y\nset format y '10^{%%T}'\nset autoscale xfix\n"
				  "set yrange [%.3g<*:*] # errors far below the largest are rounding\n"
				  "shown(value) = value > 0 ? value : NaN # zeros have no logarithm\n"
				  "set key outside right top vertical reverse Left samplen 3 font ',%d'\n",
				  1e-12 * largest_energy_error(results), curves > 18 ? 9 : 12);
	if (curves > MOST_KEYS) jn_text_print(&file, "unset key\n");
	compare_print_terminal(&file, "energy", "svg", 900, 500);
	print_energy_curves(&file, results);
	compare_print_terminal(&file, "energy", "png", 900, 500);
	jn_text_print(&file, "replot\n");
	return jn_text_close(&file);
}

// ---- drawing ----

// A picture that this comparison has not got: one of an earlier comparison would say something else.
static void remove_picture(const char* folder, const char* name) {
	static const char* const kinds[] = {"gnuplot", "svg", "png"};
	for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i) {
		char file[64], path[JN_PATH_SIZE];
		snprintf(file, sizeof file, "%s.%s", name, kinds[i]);
		if (jn_path_join(folder, file, path) == JN_OK) unlink(path);
	}
}

JnStatus compare_plots_draw(const CompareResults* results, int* count) {
	char folder[JN_PATH_SIZE];
	bool has_points = false;
	for (int g = 0; g < results->plan->group_count; ++g) has_points |= compare_group_is_shown(results, g);
	const struct {
		const char* name;
		JnStatus (*write)(const CompareResults*, const char* folder);
		bool is_wanted;
	} pictures[] = {
		{"convergence", write_convergence, has_points && results->plan->dt_key >= 0},
		{"work_precision", compare_write_work_precision, has_points},
		{"energy", write_energy, energy_curves(results) > 0},
	};
	*count = 0;
	CompareDrawing drawing = COMPARE_DRAWN;
	JN_TRY(jn_path_join(results->plan->directory, "plots", folder));
	JN_TRY(jn_folder_make(folder));
	JN_TRY(write_data(results, folder));
	for (size_t i = 0; i < sizeof pictures / sizeof *pictures; ++i) {
		if (!pictures[i].is_wanted) {
			remove_picture(folder, pictures[i].name);
			continue;
		}
		JN_TRY(pictures[i].write(results, folder));
		if (drawing != COMPARE_NO_GNUPLOT) drawing = compare_draw(folder, pictures[i].name);
		*count += drawing == COMPARE_DRAWN;
	}
	return JN_OK;
}
