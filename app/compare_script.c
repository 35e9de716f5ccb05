// The look of the pictures is that of src/record/plot_script.c.
#include "compare_script.h"

#include <math.h>
#include <string.h>

// Colours of Okabe and Ito, which stay apart for the colour-blind; points and dashes tell the rest.
static const char* const colours[COMPARE_COLOURS] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
													 "#e69f00", "#56b4e9", "#303030"};
static const int points[] = {7, 5, 9, 11, 13};

void compare_print_pen(JnTextFile* file, int index, int dash) {
	jn_text_print(file, "lw 1.8 dt %d lc rgb '%s'", dash % 5 + 1, colours[index % COMPARE_COLOURS]);
}

// A single-quoted string knows no escapes but '' for '.
void compare_print_quoted(JnTextFile* file, const char* text) {
	for (const char* at = text; *at != '\0'; ++at)
		jn_text_print(file, "%s%c", *at == '\'' ? "'" : "", (unsigned char)*at < 0x20 ? ' ' : *at);
}

const char* compare_error_words(const CompareResults* results) {
	return results->has_errors ? "position error, rms [m]" : "energy error, largest [J/kg]";
}

bool compare_run_is_shown(const CompareResults* results, int run) {
	return compare_result_error(results, run) > 0;
}

bool compare_group_is_shown(const CompareResults* results, int group) {
	for (int i = 0; i < results->plan->run_count; ++i)
		if (results->plan->runs[i].group == group && compare_run_is_shown(results, i)) return true;
	return false;
}

void compare_print_style(JnTextFile* file, const char* name, const char* doc) {
	jn_text_print(file, "# %s. To draw it again: gnuplot %s.gnuplot\n", doc, name);
	jn_text_print(file, "set encoding utf8\n"
						"set border 3 lw 0.8 lc rgb '#606060'\n"
						"set tics nomirror out scale 0.6 textcolor rgb '#303030'\n"
						"set grid lw 0.6 lt 1 lc rgb '#e2e2e2'\n"
						"set pointsize 0.8\n");
}

void compare_print_title(JnTextFile* file, const CompareResults* results, const char* words) {
	jn_text_print(file, "'");
	compare_print_quoted(file, results->plan->scene_name);
	jn_text_print(file, " — %s' noenhanced font ',16'", words);
}

void compare_print_terminal(JnTextFile* file, const char* name, const char* kind, int width, int height) {
	if (strcmp(kind, "svg") == 0)
		jn_text_print(file, "\nset terminal svg size %d,%d dynamic font 'sans-serif,14' background '#ffffff'\n", width,
					  height);
	else
		jn_text_print(file, "\nset terminal pngcairo size %d,%d font 'sans-serif,14' fontscale 1.2 linewidth 1.5\n",
					  width * 3 / 2, height * 3 / 2);
	jn_text_print(file, "set output '%s.%s'\n", name, kind);
}

static void print_group_title(JnTextFile* file, const CompareResults* results, int group, bool with_slope) {
	const double slope = compare_group_slope(results, group);
	const char* label = results->plan->groups[group];
	jn_text_print(file, "title '");
	compare_print_quoted(file, label);
	if (with_slope && isfinite(slope)) jn_text_print(file, "%sslope %.2f", *label != '\0' ? ", " : "", slope);
	jn_text_print(file, "' noenhanced");
}

// One curve a group: the columns `x` and 2 of its block.
void compare_print_groups(JnTextFile* file, const CompareResults* results, int x, CompareLegend legend) {
	const char* lead = "plot";
	for (int g = 0; g < results->plan->group_count; ++g) {
		if (!compare_group_is_shown(results, g)) continue;
		jn_text_print(file, "%s 'comparison.dat' index %d using %d:2 with linespoints pt %d ", lead, g, x,
					  points[g % (int)(sizeof points / sizeof *points)]);
		compare_print_pen(file, g, g / COMPARE_COLOURS);
		jn_text_print(file, " ");
		if (legend == COMPARE_NO_LEGEND)
			jn_text_print(file, "notitle");
		else
			print_group_title(file, results, g, legend == COMPARE_NAMES_AND_SLOPES);
		lead = ", \\\n    ";
	}
	jn_text_print(file, "\n");
}
