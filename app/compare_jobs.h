/// @file compare_jobs.h
/// The runs of a comparison as processes, so many at a time; those that are done already are kept.
#ifndef JN_APP_COMPARE_JOBS_H
#define JN_APP_COMPARE_JOBS_H

#include <sys/types.h>

#include "compare_plan.h"
#include "record/text_file.h"

typedef enum CompareState {
	COMPARE_WAITING, ///< not run: the comparison was stopped before
	COMPARE_RUNNING,
	COMPARE_DONE,
	COMPARE_FAILED,
	COMPARE_STOPPED, ///< ended early, as asked
} CompareState;

typedef struct CompareJob {
	CompareState state;
	bool is_kept; ///< done by an earlier comparison with the same settings
	pid_t process;
	char folder[JN_PATH_SIZE];
	char message[1024]; ///< why it failed, one line; or ""
} CompareJob;

typedef struct CompareJobs {
	const CompareOptions* options;
	const ComparePlan* plan;
	CompareJob* list;         ///< one a run of the plan
	const CompareRun** order; ///< the longest first
	int next;                 ///< place in `order` of the next to start
	int limit;                ///< runs at a time
	int kept, running, done, failed, stopped;
	double began;                 ///< clock when the first could start [s]
	double work_to_do, work_done; ///< steps, of the runs that are not kept
	bool is_terminal, was_stopped;
	void (*ended)(const CompareJob* job, void* user); ///< called for each run that is newly done, unless NULL
	void* user;                                       ///< handed to `ended`
} CompareJobs;

/// Find out which runs are done already; `ended` may be set after it. JN_IO_FAILED after a message. Free with compare_jobs_free in either case.
JnStatus compare_jobs_prepare(const CompareOptions* options, const ComparePlan* plan, CompareJobs* jobs);

/// Run the others. Ctrl-C lets the running ones finish their step and starts no more. A run that fails is marked so; only
/// what makes further runs pointless is returned, after a message.
JnStatus compare_jobs_run(CompareJobs* jobs);
void compare_jobs_free(CompareJobs* jobs);

#endif
