/// @file report.h
/// Sums of what steps have cost.
#ifndef JN_BASE_REPORT_H
#define JN_BASE_REPORT_H

#include "jounce/base.h"

/// sum += one, but for what only the latest can tell (residual, error) and for what others fill in: rejections and the times of
/// contact.
static inline void jn_report_add(JnReport* sum, const JnReport* one) {
	sum->newton += one->newton;
	sum->forces += one->forces;
	sum->tangents += one->tangents;
	sum->factorizations += one->factorizations;
	sum->solves += one->solves;
	sum->iterations += one->iterations;
	for (int way = 0; way < JN_WAY_COUNT; ++way) sum->served[way] += one->served[way];
	sum->changes += one->changes;
	sum->indefinite += one->indefinite;
	sum->backtracks += one->backtracks;
	sum->minimized += one->minimized;
	sum->residual = one->residual;
	sum->error = one->error;
	sum->seconds_predict += one->seconds_predict;
}

#endif
