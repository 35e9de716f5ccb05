// The child writes into two files in memory, one for its result and one for its messages, and leaves by _exit.
#define _GNU_SOURCE // memfd_create, close_range
#include "base/guard.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/log.h"

/// Exit codes of the child are FIRST_CODE - status: none that a crash or a sanitizer would choose.
enum { FIRST_CODE = 100, FEWEST_CODE = 90, MOST_CODE = 110, MESSAGE_SIZE = 2048 };

typedef struct Child {
	FILE *result, *messages;
} Child;

static void keep_message(void* user, JnLogLevel level, const char* message) {
	FILE* messages = ((Child*)user)->messages;
	fputc((int)level, messages);
	fwrite(message, 1, strlen(message) + 1, messages);
}

static void pass_messages_on(FILE* messages) {
	char text[MESSAGE_SIZE];
	rewind(messages);
	for (int level; (level = fgetc(messages)) != EOF;) {
		int length = 0;
		for (int c; (c = fgetc(messages)) != EOF && c != '\0';)
			if (length < MESSAGE_SIZE - 1) text[length++] = (char)c;
		text[length] = '\0';
		if (level == JN_LOG_ERROR)
			jn_error(JN_BAD_INPUT, "%s", text);
		else if (level == JN_LOG_WARNING)
			jn_warn("%s", text);
		else
			jn_info("%s", text);
	}
}

static FILE* open_memory(void) {
	const int file = memfd_create("jounce", MFD_CLOEXEC);
	FILE* stream = file >= 0 ? fdopen(file, "w+") : NULL;
	if (stream == NULL && file >= 0) close(file);
	return stream;
}

/// Address space in use [bytes].
static size_t address_space(void) {
	unsigned long pages = 0;
	FILE* file = fopen("/proc/self/statm", "r");
	if (file == NULL) return 0;
	if (fscanf(file, "%lu", &pages) != 1) pages = 0;
	fclose(file);
	return (size_t)pages * (size_t)sysconf(_SC_PAGESIZE);
}

static void limit(__rlimit_resource_t resource, rlim_t most) {
	struct rlimit now;
	if (getrlimit(resource, &now) != 0) return;
	if (now.rlim_max != RLIM_INFINITY && now.rlim_max < most) most = now.rlim_max;
	now.rlim_cur = most;
	setrlimit(resource, &now);
}

/// Silent, limited, and without the handlers of whoever forked it.
static void prepare_child(size_t memory) {
	static const int signals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT, SIGXCPU, SIGPROF};
	for (size_t i = 0; i < sizeof signals / sizeof signals[0]; ++i) signal(signals[i], SIG_DFL);
	const int nowhere = open("/dev/null", O_RDWR);
	if (nowhere >= 0) {
		dup2(nowhere, STDOUT_FILENO);
		dup2(nowhere, STDERR_FILENO);
	}
	limit(RLIMIT_CORE, 0);
	limit(RLIMIT_AS, address_space() + memory);
}

static _Noreturn void be_child(Child* child, const char* what, JnGuardLimits limits, JnGuardedWork work, void* user) {
	prepare_child(limits.memory);
	limit(RLIMIT_CPU, (rlim_t)limits.seconds);
	jn_log_set_sink(keep_message, child);
	JnStatus status = work(user, child->result);
	if ((fflush(child->result) != 0 || ferror(child->result)) && status >= JN_OK)
		status = jn_error(JN_OUT_OF_MEMORY, "%s: no memory for what the library made of it", what);
	fflush(child->messages);
	_exit(FIRST_CODE - (int)status);
}

static JnStatus judge(const char* what, const char* remedy, int ending) {
	if (WIFEXITED(ending) && WEXITSTATUS(ending) >= FEWEST_CODE && WEXITSTATUS(ending) <= MOST_CODE)
		return (JnStatus)(FIRST_CODE - WEXITSTATUS(ending));
	const int reason = WIFSIGNALED(ending) ? WTERMSIG(ending) : 0;
	if (reason == SIGXCPU || reason == SIGPROF)
		return jn_error(JN_BAD_INPUT, "%s: the library that works on it comes to no end%s%s", what,
						remedy != NULL ? "; " : "", remedy != NULL ? remedy : "");
	return jn_error(JN_BAD_INPUT, "%s: the library that works on it crashed (%s); %s", what,
					reason != 0 ? strsignal(reason) : "it left", remedy != NULL ? remedy : "is it damaged?");
}

static JnStatus wait_for(const char* what, const char* remedy, pid_t id) {
	int ending = 0;
	while (waitpid(id, &ending, 0) < 0)
		if (errno != EINTR)
			return jn_error(JN_IO_FAILED, "%s: lost the process that works on it: %s", what, strerror(errno));
	return judge(what, remedy, ending);
}

JnStatus jn_guard_run(const char* what, JnGuardLimits limits, JnGuardedWork work, void* user, FILE** result) {
	Child child = {.result = open_memory(), .messages = open_memory()};
	const pid_t id = child.result != NULL && child.messages != NULL ? fork() : -1;
	if (id == 0) be_child(&child, what, limits, work, user);
	const JnStatus status = id < 0
								? jn_error(JN_IO_FAILED, "%s: cannot start a process for it: %s", what, strerror(errno))
								: wait_for(what, limits.remedy, id);
	if (id > 0) pass_messages_on(child.messages);
	if (child.messages != NULL) fclose(child.messages);
	if (status != JN_OK && child.result != NULL) fclose(child.result);
	*result = NULL;
	if (status != JN_OK) return status;
	rewind(child.result);
	*result = child.result;
	return JN_OK;
}

// ---- a child that answers ----

static void close_all_but(int file) {
	if (file > STDERR_FILENO + 1) close_range(STDERR_FILENO + 1, (unsigned)file - 1, 0);
	close_range((unsigned)file + 1, ~0U, 0);
}

/// Ctrl-C is for the parent to act on: the child goes when it is no longer asked.
static _Noreturn void be_service(JnGuardChild own, JnGuardService* serve, void* user) {
	own.id = 0;
	close_all_but(own.socket);
	own.address_space = address_space();
	prepare_child(own.limits.memory);
	signal(SIGINT, SIG_IGN);
	signal(SIGTERM, SIG_IGN);
	jn_guard_wind(&own, 0);
	serve(&own, user);
	_exit(FIRST_CODE - (int)JN_OK);
}

JnStatus jn_guard_start(const char* what, JnGuardLimits limits, JnGuardService* serve, void* user,
						JnGuardChild* child) {
	int ends[2] = {-1, -1};
	const bool is_ready = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
	*child = (JnGuardChild){.id = is_ready ? fork() : -1, .socket = ends[0], .limits = limits};
	if (child->id == 0) be_service((JnGuardChild){.socket = ends[1], .limits = limits}, serve, user);
	const int reason = errno;
	if (ends[1] >= 0) close(ends[1]);
	if (child->id > 0) return JN_OK;
	if (ends[0] >= 0) close(ends[0]);
	return jn_error(JN_IO_FAILED, "%s: cannot start a process for it: %s", what, strerror(reason));
}

void jn_guard_wind(const JnGuardChild* own, int more_seconds) {
	const struct itimerval time = {.it_value.tv_sec = own->limits.seconds + more_seconds};
	setitimer(ITIMER_PROF, &time, NULL);
}

void jn_guard_allow(const JnGuardChild* own, size_t more) {
	limit(RLIMIT_AS, own->address_space + own->limits.memory + more);
}

JnStatus jn_guard_end(const char* what, const JnGuardChild* child) {
	shutdown(child->socket, SHUT_RDWR);
	close(child->socket);
	return wait_for(what, child->limits.remedy, child->id);
}
