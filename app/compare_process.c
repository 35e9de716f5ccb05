// fork and exec, for posix_spawn cannot ask for a signal when the parent dies.
#define _GNU_SOURCE // pipe2
#include "compare_process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

// In the child: between fork and exec only calls that are safe in a process that had threads.
static bool redirect(const char* folder, int input, const char* log) {
	if (folder != NULL && chdir(folder) != 0) return false;
	const int words = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
	if (input < 0 || words < 0) return false;
	return dup2(input, STDIN_FILENO) >= 0 && dup2(words, STDOUT_FILENO) >= 0 && dup2(words, STDERR_FILENO) >= 0;
}

static void restore_signals(void) {
	sigset_t empty;
	sigemptyset(&empty);
	sigprocmask(SIG_SETMASK, &empty, NULL);
	signal(SIGINT, SIG_DFL);
	signal(SIGTERM, SIG_DFL);
	signal(SIGPIPE, SIG_DFL);
}

static void become(const char* program, const char* const arguments[], const char* folder, int input, const char* log) {
	restore_signals();
	setpgid(0, 0);
	prctl(PR_SET_PDEATHSIG, SIGINT);
	if (redirect(folder, input, log)) execvp(program, (char* const*)arguments);
}

// The pipe closes when exec succeeds; otherwise it brings the reason.
static pid_t start(const char* program, const char* const arguments[], const char* folder, int input, const char* log) {
	int ends[2], reason = 0;
	if (pipe2(ends, O_CLOEXEC) != 0) return -1;
	const pid_t child = fork();
	if (child == 0) {
		become(program, arguments, folder, input, log);
		reason = errno;
		_exit(write(ends[1], &reason, sizeof reason) == sizeof reason ? 127 : 126);
	}
	reason = child < 0 ? errno : 0;
	close(ends[1]);
	ssize_t length = 0;
	while (child > 0 && (length = read(ends[0], &reason, sizeof reason)) < 0 && errno == EINTR) continue;
	close(ends[0]);
	if (child > 0 && length <= 0) return child;
	if (child > 0) waitpid(child, NULL, 0);
	errno = reason;
	return -1;
}

pid_t compare_process_start(const char* program, const char* const arguments[], const char* folder, const char* log) {
	const int none = open("/dev/null", O_RDONLY | O_CLOEXEC);
	const pid_t process = start(program, arguments, folder, none, log);
	const int reason = errno;
	if (none >= 0) close(none);
	errno = reason;
	return process;
}

pid_t compare_process_feed(const char* program, const char* const arguments[], const char* log, int* input) {
	int ends[2];
	if (pipe2(ends, O_CLOEXEC) != 0) return -1;
	const pid_t process = start(program, arguments, NULL, ends[0], log);
	const int reason = errno;
	close(ends[0]);
	if (process < 0) close(ends[1]);
	*input = process < 0 ? -1 : ends[1];
	errno = reason;
	return process;
}

int compare_process_status(int wait_status) {
	return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

int compare_process_wait(pid_t process) {
	int status = 0;
	while (waitpid(process, &status, 0) < 0)
		if (errno != EINTR) return -1;
	return compare_process_status(status);
}
