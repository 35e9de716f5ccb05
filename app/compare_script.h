/// @file compare_script.h
/// Words that the gnuplot scripts of a comparison share. Lengths of pictures are in pixels of the SVG.
#ifndef JN_APP_COMPARE_SCRIPT_H
#define JN_APP_COMPARE_SCRIPT_H

#include "compare_results.h"
#include "record/text_file.h"

enum { COMPARE_COLOURS = 7 };

/// What the legend says of each group.
typedef enum CompareLegend { COMPARE_NO_LEGEND, COMPARE_NAMES, COMPARE_NAMES_AND_SLOPES } CompareLegend;

/// Is the run done, with an error that has a logarithm? And is a run of the group?
bool compare_run_is_shown(const CompareResults* results, int run);
bool compare_group_is_shown(const CompareResults* results, int group);

/// The error of compare_result_error as the label of an axis.
const char* compare_error_words(const CompareResults* results);

/// The inside of a single-quoted string.
void compare_print_quoted(JnTextFile* file, const char* text);
/// Width, dash (from 0) and colour of a curve.
void compare_print_pen(JnTextFile* file, int index, int dash);
/// The beginning of every script: what it is, borders, grid.
void compare_print_style(JnTextFile* file, const char* name, const char* doc);
/// "scene — words" in quotes, with its font.
void compare_print_title(JnTextFile* file, const CompareResults* results, const char* words);
/// Draw into name.kind from here on; `kind` is "svg" or "png".
void compare_print_terminal(JnTextFile* file, const char* name, const char* kind, int width, int height);
/// One curve a group: the error over column `x` of comparison.dat (1 step, 3 factorisations, 4 wall time).
void compare_print_groups(JnTextFile* file, const CompareResults* results, int x, CompareLegend legend);

/// Write work_precision.gnuplot into `folder`.
JnStatus compare_write_work_precision(const CompareResults* results, const char* folder);

#endif
