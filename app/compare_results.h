/// @file compare_results.h
/// What the runs of a comparison cost and how far they are from the reference.
#ifndef JN_APP_COMPARE_RESULTS_H
#define JN_APP_COMPARE_RESULTS_H

#include "compare_jobs.h"

/// Distance of a probe's path from the reference's, at the times that both have after the start.
typedef struct ComparePath {
	double rms, max; ///< [m]; NAN without such times
} ComparePath;

/// NAN stands for what is not known.
typedef struct CompareResult {
	double steps, rejected, newton, factorizations, solves, forces;
	double wall_seconds;               ///< of stepping [s]
	double energy_end, energy_max;     ///< |e(t) - e(0)| at the end and its largest [J/kg]
	double position_rms, position_max; ///< over the nodes, at the final time [m]
	double velocity_rms, velocity_max; ///< [m/s]
	double order;                      ///< against the next coarser step of the same group
	ComparePath* paths;                ///< one a probe
} CompareResult;

typedef struct CompareResults {
	JnArena arena;
	const ComparePlan* plan;
	const CompareJobs* jobs;
	CompareResult* list; ///< one a run of the plan
	bool has_errors;     ///< there is a reference, and it is done
	int probe_count;
	const char** probes; ///< names
} CompareResults;

/// Read what the runs wrote. A run whose files cannot be used becomes a failed job. JN_OUT_OF_MEMORY. Free with
/// compare_results_free in either case.
JnStatus compare_results_read(CompareJobs* jobs, CompareResults* results);
void compare_results_free(CompareResults* results);

/// The error that convergence is judged by: of position when there is a reference, of energy otherwise.
double compare_result_error(const CompareResults* results, int run);

/// The next coarser run of the same group, or -1.
int compare_run_coarser(const ComparePlan* plan, int run);

/// Slope of error over step in a group, by least squares of the logarithms; NAN below two points.
double compare_group_slope(const CompareResults* results, int group);

#endif
