// Each run is a process of this same program. A run's folder has settings.txt, all that its result depends on; when that
// is unchanged and its summary says "done", the run is kept.
#define _GNU_SOURCE // CPU_COUNT
#include "compare_jobs.h"

#include <errno.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/folder.h"
#include "base/log.h"
#include "base/timer.h"
#include "compare_files.h"
#include "compare_process.h"
#include "compare_progress.h"
#include "compare_recording.h"
#include "interrupt.h"

static const char settings_name[] = "settings.txt";

// A second Ctrl-C ends this process at once, and the runs with it. SIGCHLD waits to be asked for.
static void handle_signals(void) {
	sigset_t ended;
	app_catch_interrupts(0);
	sigemptyset(&ended);
	sigaddset(&ended, SIGCHLD);
	sigprocmask(SIG_BLOCK, &ended, NULL);
}

static const char* scene_of(const CompareJobs* jobs, const CompareRun* run) {
	return run->scene != NULL ? run->scene : jobs->options->scene;
}

// All that a run's result depends on, as text.
static void print_settings(JnTextFile* file, const CompareJobs* jobs, const CompareRun* run) {
	jn_text_print(file, "jounce %s\n", JN_VERSION);
	for (int i = 0; i < run->set_count; ++i) jn_text_print(file, "--set %s\n", run->sets[i]);
	char* scene = compare_file_read(scene_of(jobs, run));
	jn_text_print(file, "\n%s", scene != NULL ? scene : ""); // the run itself says why it cannot be read
	free(scene);
}

static bool has_same_settings(const CompareJobs* jobs, const CompareRun* run, const char* folder) {
	char path[JN_PATH_SIZE], *expected = NULL;
	size_t size = 0;
	if (jn_path_join(folder, settings_name, path) != JN_OK) return false;
	char* found = compare_file_read(path);
	JnTextFile memory = {.stream = open_memstream(&expected, &size)};
	if (memory.stream != NULL) {
		print_settings(&memory, jobs, run);
		fclose(memory.stream);
	}
	const bool is_same = found != NULL && expected != NULL && strcmp(found, expected) == 0;
	free(found);
	free(expected);
	return is_same;
}

static bool has_ended_well(const char* folder) {
	char path[JN_PATH_SIZE];
	if (jn_path_join(folder, "summary.json", path) != JN_OK) return false;
	char* summary = compare_file_read(path);
	const bool is_done = compare_summary_is_done(summary);
	free(summary);
	return is_done;
}

static int longest_first(const void* a, const void* b) {
	const CompareRun *first = *(const CompareRun*const*)a, *second = *(const CompareRun*const*)b;
	if (first->work != second->work) return first->work > second->work ? -1 : 1;
	return (first > second) - (first < second);
}

static JnStatus allocate(CompareJobs* jobs) {
	const size_t count = (size_t)jobs->plan->run_count;
	jobs->list = calloc(count, sizeof *jobs->list);
	jobs->order = calloc(count, sizeof *jobs->order);
	if (jobs->list != NULL && jobs->order != NULL) return JN_OK;
	return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for %zu runs", count);
}

static int processor_count(void) {
	cpu_set_t ours;
	return sched_getaffinity(0, sizeof ours, &ours) == 0 ? CPU_COUNT(&ours) : 1;
}

static JnStatus look_at_run(CompareJobs* jobs, int index) {
	const CompareRun* run = &jobs->plan->runs[index];
	CompareJob* job = &jobs->list[index];
	jobs->order[index] = run;
	JN_TRY(compare_run_folder(jobs->plan->directory, run->name, job->folder));
	job->is_kept = has_ended_well(job->folder) && has_same_settings(jobs, run, job->folder);
	if (job->is_kept) job->state = COMPARE_DONE;
	jobs->kept += job->is_kept;
	jobs->work_to_do += job->is_kept ? 0 : run->work;
	return JN_OK;
}

JnStatus compare_jobs_prepare(const CompareOptions* options, const ComparePlan* plan, CompareJobs* jobs) {
	const int fitting = processor_count() / options->threads;
	*jobs = (CompareJobs){.options = options,
						  .plan = plan,
						  .limit = options->jobs > 0 ? options->jobs
								   : fitting > 0     ? fitting
													 : 1,
						  .is_terminal = isatty(STDOUT_FILENO) != 0};
	JN_TRY(allocate(jobs));
	for (int i = 0; i < plan->run_count; ++i) JN_TRY(look_at_run(jobs, i));
	jobs->done = jobs->kept;
	qsort(jobs->order, (size_t)plan->run_count, sizeof *jobs->order, longest_first);
	return JN_OK;
}

// The summary of an earlier run goes first, so that one that says "done" always belongs to the settings beside it.
static JnStatus prepare_folder(const CompareJobs* jobs, const CompareRun* run, const char* folder) {
	char path[JN_PATH_SIZE];
	JN_TRY(jn_folder_make(folder));
	JN_TRY(jn_path_join(folder, "summary.json", path));
	if (unlink(path) != 0 && errno != ENOENT)
		return jn_error(JN_IO_FAILED, "%s: cannot be replaced: %s", path, strerror(errno));
	JnTextFile file;
	JN_TRY(jn_text_open(&file, folder, settings_name, JN_TEXT_REPLACE));
	print_settings(&file, jobs, run);
	return jn_text_close(&file);
}

static JnStatus start(CompareJobs* jobs, const CompareRun* run) {
	CompareJob* job = &jobs->list[run - jobs->plan->runs];
	char threads[16], log[JN_PATH_SIZE];
	snprintf(threads, sizeof threads, "%d", jobs->options->threads);
	JN_TRY(prepare_folder(jobs, run, job->folder));
	JN_TRY(jn_path_join(job->folder, "run.log", log));
	const char** arguments = calloc(2 * (size_t)run->set_count + 10, sizeof *arguments);
	if (arguments == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the words of a command");
	int count = 0;
	const char* const words[] = {"jounce", "run", "--quiet", "--threads", threads, "--output", job->folder};
	for (size_t i = 0; i < sizeof words / sizeof *words; ++i) arguments[count++] = words[i];
	for (int i = 0; i < run->set_count; ++i) {
		arguments[count++] = "--set";
		arguments[count++] = run->sets[i];
	}
	arguments[count++] = "--";
	arguments[count] = scene_of(jobs, run);
	job->process = compare_process_start("/proc/self/exe", arguments, NULL, log);
	free(arguments);
	if (job->process < 0) return jn_error(JN_IO_FAILED, "a run cannot be started: %s", strerror(errno));
	job->state = COMPARE_RUNNING;
	++jobs->running;
	return JN_OK;
}

static JnStatus start_next(CompareJobs* jobs) {
	while (jobs->next < jobs->plan->run_count && jobs->running < jobs->limit && !app_interrupted) {
		const CompareRun* run = jobs->order[jobs->next++];
		if (!jobs->list[run - jobs->plan->runs].is_kept) JN_TRY(start(jobs, run));
	}
	return JN_OK;
}

// The last error that the run told, without the command's name in front.
static void find_message(CompareJob* job, int status) {
	static const char mark[] = "jounce: error: ";
	char path[JN_PATH_SIZE], *last = NULL;
	char* text = jn_path_join(job->folder, "run.log", path) == JN_OK ? compare_file_read(path) : NULL;
	for (char* at = text; at != NULL && (at = strstr(at, mark)) != NULL;) last = at += sizeof mark - 1;
	if (status > 128)
		snprintf(job->message, sizeof job->message, "ended by the signal %s", strsignal(status - 128));
	else if (last != NULL)
		snprintf(job->message, sizeof job->message, "%.*s", (int)strcspn(last, "\n"), last);
	else
		snprintf(job->message, sizeof job->message, "exit status %d; see %.900s", status, path);
	free(text);
}

static void finish(CompareJobs* jobs, CompareJob* job, int status) {
	--jobs->running;
	jobs->work_done += jobs->plan->runs[job - jobs->list].work;
	if (has_ended_well(job->folder) && status == 0) {
		job->state = COMPARE_DONE;
		++jobs->done;
		if (jobs->ended != NULL) jobs->ended(job, jobs->user);
	} else if (jobs->was_stopped && (status == 0 || status == 128 + SIGINT)) {
		job->state = COMPARE_STOPPED;
		++jobs->stopped;
	} else {
		job->state = COMPARE_FAILED;
		++jobs->failed;
		find_message(job, status);
	}
	compare_progress_tell(jobs, job);
}

static void collect(CompareJobs* jobs) {
	for (int i = 0; i < jobs->plan->run_count; ++i) {
		CompareJob* job = &jobs->list[i];
		int status = 0;
		if (job->state == COMPARE_RUNNING && waitpid(job->process, &status, WNOHANG) == job->process)
			finish(jobs, job, compare_process_status(status));
	}
}

static void stop_running(CompareJobs* jobs) {
	jobs->was_stopped = true;
	for (int i = 0; i < jobs->plan->run_count; ++i)
		if (jobs->list[i].state == COMPARE_RUNNING) kill(jobs->list[i].process, SIGINT);
}

static void wait_for_news(void) {
	const struct timespec pause = {.tv_nsec = 200 * 1000 * 1000};
	sigset_t ended;
	sigemptyset(&ended);
	sigaddset(&ended, SIGCHLD);
	sigtimedwait(&ended, NULL, &pause);
}

JnStatus compare_jobs_run(CompareJobs* jobs) {
	JnStatus status = JN_OK;
	handle_signals();
	jobs->began = jn_seconds();
	for (;;) {
		if (status == JN_OK) status = start_next(jobs);
		if ((app_interrupted || status != JN_OK) && !jobs->was_stopped) stop_running(jobs);
		if (jobs->running == 0) break;
		compare_progress_show(jobs);
		wait_for_news();
		collect(jobs);
	}
	compare_progress_clear(jobs);
	return status;
}

void compare_jobs_free(CompareJobs* jobs) {
	free(jobs->list);
	free(jobs->order);
}
