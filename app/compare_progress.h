/// @file compare_progress.h
/// What a comparison says while it runs.
#ifndef JN_APP_COMPARE_PROGRESS_H
#define JN_APP_COMPARE_PROGRESS_H

#include "compare_jobs.h"

/// One line that is written over and over, on a terminal.
void compare_progress_show(const CompareJobs* jobs);
/// Take that line away.
void compare_progress_clear(const CompareJobs* jobs);
/// A line about a run that has just ended; on a terminal the line that is written over says enough.
void compare_progress_tell(const CompareJobs* jobs, const CompareJob* job);

#endif
