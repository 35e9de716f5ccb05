/// @file compare_plots.h
/// The pictures of a comparison, by gnuplot; scripts and data stay beside them in plots/.
#ifndef JN_APP_COMPARE_PLOTS_H
#define JN_APP_COMPARE_PLOTS_H

#include "compare_results.h"

/// Write plots/ and draw: convergence (when step.dt is varied), work_precision and energy. Without gnuplot the scripts are
/// written all the same, with a warning. `*count` is the number of pictures drawn. JN_IO_FAILED after a message.
JnStatus compare_plots_draw(const CompareResults* results, int* count);

#endif
