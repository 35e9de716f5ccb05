// work_precision: error over factorisations, and over wall time.
#include <math.h>
#include <string.h>

#include "compare_script.h"

typedef enum Cost { FACTORIZATIONS = 3, WALL_TIME = 4 } Cost; // column of comparison.dat

static double run_cost(const CompareResults* results, int run, Cost cost) {
	if (!compare_run_is_shown(results, run)) return NAN;
	return cost == FACTORIZATIONS ? results->list[run].factorizations : results->list[run].wall_seconds;
}

// Marks at 1, 2 and 5 where powers of ten alone would be few.
static void print_marks(JnTextFile* file, double low, double high) {
	const char* lead = "set xtics (";
	for (int power = (int)floor(log10(low)); pow(10, power) <= high; ++power) {
		const double decade = pow(10, power);
		static const int leading[] = {1, 2, 5};
		for (int i = 0; i < 3; ++i) {
			if (leading[i] * decade < low || leading[i] * decade > high) continue;
			jn_text_print(file, "%s%g", lead, leading[i] * decade);
			lead = ", ";
		}
	}
	jn_text_print(file, *lead == ',' ? ")\n" : "set xtics auto\n");
}

// False when nothing has this cost.
static bool print_cost_axis(JnTextFile* file, const CompareResults* results, Cost cost) {
	double low = INFINITY, high = 0;
	for (int i = 0; i < results->plan->run_count - results->plan->has_reference; ++i) {
		const double value = run_cost(results, i, cost);
		if (!(value > 0)) continue;
		low = fmin(low, value);
		high = fmax(high, value);
	}
	if (!(high > 0)) return false;
	jn_text_print(file, "set xlabel '%s'\nset xrange [%g:%g]\n",
				  cost == FACTORIZATIONS ? "factorisations" : "wall time [s]", low / 1.3, high * 1.3);
	if (high < 100 * low)
		print_marks(file, low / 1.3, high * 1.3);
	else
		jn_text_print(file, "set xtics auto\n");
	return true;
}

// Share of the picture's width that the legend does not need.
static double right_margin(const CompareResults* results) {
	size_t longest = 0;
	for (int g = 0; g < results->plan->group_count; ++g) {
		const size_t length = strlen(results->plan->groups[g]);
		if (length > longest) longest = length;
	}
	return longest == 0 ? 0.97 : fmax(0.6, 0.93 - 0.0085 * (double)longest);
}

static bool has_factorizations(const CompareResults* results) {
	for (int i = 0; i < results->plan->run_count - results->plan->has_reference; ++i)
		if (run_cost(results, i, FACTORIZATIONS) > 0) return true;
	return false;
}

// Explicit methods factor nothing: then there is one panel.
static void print_panels(JnTextFile* file, const CompareResults* results) {
	const double right = right_margin(results);
	const bool has_left = has_factorizations(results);
	jn_text_print(file, "set multiplot layout 1,%d margins 0.08,%.3f,0.14,0.88 spacing 0.08 title ", has_left ? 2 : 1,
				  right);
	compare_print_title(file, results, "work and precision");
	jn_text_print(file, "\nset ylabel '%s'\nunset key\n", compare_error_words(results));
	if (has_left) {
		print_cost_axis(file, results, FACTORIZATIONS);
		compare_print_groups(file, results, FACTORIZATIONS, COMPARE_NO_LEGEND);
		jn_text_print(file, "unset ylabel\n");
	}
	if (right < 0.97)
		jn_text_print(file,
					  "set key at screen %.3f, 0.88 left top vertical reverse Left samplen 2 spacing 1.2 font ',12'\n",
					  right + 0.01);
	if (print_cost_axis(file, results, WALL_TIME)) compare_print_groups(file, results, WALL_TIME, COMPARE_NAMES);
	jn_text_print(file, "unset multiplot\n");
}

JnStatus compare_write_work_precision(const CompareResults* results, const char* folder) {
	JnTextFile file;
	JN_TRY(jn_text_open(&file, folder, "work_precision.gnuplot", JN_TEXT_REPLACE));
	compare_print_style(&file, "work_precision", "Error over cost: lower and further left is better");
	jn_text_print(&file, "set logscale xy\nset format y '10^{%%T}'\nset format x '%%g'\n");
	compare_print_terminal(&file, "work_precision", "svg", 1100, 480);
	print_panels(&file, results);
	compare_print_terminal(&file, "work_precision", "png", 1100, 480);
	print_panels(&file, results);
	return jn_text_close(&file);
}
