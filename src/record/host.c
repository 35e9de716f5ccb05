// Facts about the machine from uname, /proc/cpuinfo and the clocks.
#include "record/host.h"

#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

static void copy_text(char* out, size_t size, const char* text) {
	snprintf(out, size, "%s", text);
}

// A line of /proc/cpuinfo reads "model name\t: AMD EPYC 7763".
static void read_processor(char* out, size_t size) {
	FILE* stream = fopen("/proc/cpuinfo", "r");
	if (stream == NULL) return;
	char line[256];
	while (fgets(line, sizeof line, stream) != NULL) {
		const char* value = strchr(line, ':');
		if (value == NULL || strncmp(line, "model name", 10) != 0) continue;
		value += 1 + strspn(value + 1, " \t");
		line[strcspn(line, "\n")] = '\0';
		copy_text(out, size, value);
		break;
	}
	fclose(stream);
}

JnHost jn_host_describe(void) {
	JnHost host = {.name = "unknown", .system = "unknown", .processor = "unknown"};
	struct utsname names;
	if (uname(&names) == 0) {
		copy_text(host.name, sizeof host.name, names.nodename);
		copy_text(host.processor, sizeof host.processor, names.machine);
		snprintf(host.system, sizeof host.system, "%s %s %s", names.sysname, names.release, names.machine);
	}
	read_processor(host.processor, sizeof host.processor);
	const long cores = sysconf(_SC_NPROCESSORS_ONLN);
	host.cores = cores > 0 ? (int)cores : 0;
	return host;
}

void jn_host_time(char out[32]) {
	const time_t now = time(NULL);
	struct tm parts;
	gmtime_r(&now, &parts);
	strftime(out, 32, "%Y-%m-%dT%H:%M:%SZ", &parts);
}
