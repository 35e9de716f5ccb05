#include "compare_report.h"

#include <stdlib.h>
#include <unistd.h>

#include "base/log.h"
#include "report.h"

JnStatus compare_report_write(const char* title, const CompareJobs* jobs, bool* is_written) {
	*is_written = false;
	char path[JN_PATH_SIZE], note[256];
	const int count = jobs->plan->run_count;
	JN_TRY(jn_path_join(jobs->plan->directory, "report.html", path));
	const char** folders = calloc((size_t)count, sizeof *folders);
	if (folders == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the report");
	int known = 0;
	for (int i = 0; i < count; ++i)
		if (jobs->list[i].state == COMPARE_DONE || jobs->list[i].state == COMPARE_FAILED)
			folders[known++] = jobs->list[i].folder;
	snprintf(note, sizeof note, "%s`jounce report` on folders in runs/ makes a page with pictures.",
			 known > REPORT_MOST_RUNS ? "These are the first of the runs. " : "");
	unlink(path); // one of an earlier comparison would say something else
	const JnStatus status = report_write_folders(&(ReportOptions){.output = path, .title = title, .note = note}, known,
												 folders, is_written);
	free(folders);
	return status;
}
