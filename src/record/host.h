/// @file host.h
/// What a recording says about where and when it was made.
#ifndef JN_RECORD_HOST_H
#define JN_RECORD_HOST_H

#include <stddef.h>

typedef struct JnHost {
	char name[65];       ///< of the machine
	char system[200];    ///< "Linux 6.1.0 x86_64"
	char processor[128]; ///< "AMD EPYC 7763 64-Core Processor"; the architecture when that is unknown
	int cores;           ///< online
} JnHost;

/// Ask the machine. Never fails: what is unknown stays "unknown" or 0.
JnHost jn_host_describe(void);

/// "2026-11-22T08:30:00Z": the time now, UTC.
void jn_host_time(char out[32]);

#endif
