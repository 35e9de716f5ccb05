/// @file timer.h
/// Wall time.
#ifndef JN_BASE_TIMER_H
#define JN_BASE_TIMER_H

/// Seconds on a clock that only moves forward.
double jn_seconds(void);

#endif
