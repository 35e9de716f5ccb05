#include "run.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "jounce/scene.h"
#include "random_scene.h"

enum {
	REFUSED = 2,
	HANG_FACTOR = 20,  // of the time after which no step begins: one step may be many attempts
	SLEEP_FACTOR = 300 // the same of wall time, on a busy machine
};

static void limit(int resource, long most, long end) {
	setrlimit(resource, &(struct rlimit){(rlim_t)most, (rlim_t)end});
}

static volatile sig_atomic_t time_is_up;

static void on_time_up(int number) {
	(void)number;
	time_is_up = 1;
}

static bool is_enough(void* user, const JnProgress* progress) {
	const RunOptions* options = user;
	return progress->steps < options->steps && !time_is_up;
}

// In the child: what `jounce run` does.
static int simulate(const RunOptions* options, const char* folder) {
	char scene_path[512], out[512];
	snprintf(scene_path, sizeof scene_path, "%s/scene.yaml", folder);
	snprintf(out, sizeof out, "%s/out", folder);
	JnScene* scene = NULL;
	JnRunResult result;
	JnStatus status = jn_scene_load(scene_path, 0, NULL, &scene);
	const JnRunOptions run = {.directory = out, .threads = 1, .progress = is_enough, .user = (void*)options};
	if (status == JN_OK) status = jn_scene_run(scene, &run, &result);
	jn_scene_destroy(scene);
	return status == JN_OK ? 0 : status == JN_BAD_INPUT ? REFUSED : status == JN_IO_FAILED ? 3 : 1;
}

static void become_child(const RunOptions* options, const char* folder) {
	char path[512];
	snprintf(path, sizeof path, "%s/stderr", folder);
	const int err = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666), out = open("/dev/null", O_WRONLY);
	if (err < 0 || out < 0 || dup2(err, STDERR_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0) _exit(4);
	signal(SIGXCPU, on_time_up);
	limit(RLIMIT_CPU, options->cpu, HANG_FACTOR * options->cpu);
	limit(RLIMIT_FSIZE, options->files << 20, options->files << 20);
	limit(RLIMIT_CORE, 0, 0);
	if (options->memory > 0) limit(RLIMIT_AS, options->memory << 20, options->memory << 20);
	alarm((unsigned)(SLEEP_FACTOR * options->cpu));
	exit(simulate(options, folder));
}

static int write_scene(const RunOptions* options, long index, int attempt, const char* folder) {
	char path[512];
	snprintf(path, sizeof path, "%s/scene.yaml", folder);
	if (mkdir(folder, 0777) != 0 && errno != EEXIST) return -1;
	FILE* file = fopen(path, "w");
	if (file == NULL) return -1;
	random_scene_write((uint64_t)options->seed, index, attempt, file);
	return fclose(file);
}

static int run_draw(const RunOptions* options, long index, int attempt, int* status) {
	char name[64], folder[400];
	snprintf(name, sizeof name, "seed%ld_%ld_%d", options->seed, index, attempt);
	snprintf(folder, sizeof folder, "%s/%s", options->folder, name);
	if (write_scene(options, index, attempt, folder) != 0) return -1;
	fflush(stdout);
	const pid_t child = fork();
	if (child == 0) become_child(options, folder);
	struct rusage usage;
	int word = 0;
	if (child < 0 || wait4(child, &word, 0, &usage) != child) return -1;
	*status = WIFEXITED(word) ? WEXITSTATUS(word) : -WTERMSIG(word);
	const double seconds = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
						   1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
	printf("%s %ld %d %d %.3f %.1f\n", name, index, attempt, *status, seconds, (double)usage.ru_maxrss / 1024);
	return 0;
}

int random_scenes_run(const RunOptions* options) {
	setenv("JOUNCE_CACHE", "off", 1);
	for (long index = options->first; index < options->first + options->count; ++index) {
		int status = REFUSED;
		for (int attempt = 0; attempt < options->attempts && status == REFUSED; ++attempt) {
			if (run_draw(options, index, attempt, &status) == 0) continue;
			perror(options->folder);
			return 1;
		}
	}
	return 0;
}
