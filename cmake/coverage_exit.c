// For the preset coverage alone. Files are read in children that leave by _exit, and what such a child counted would be lost.
// Where a test limits the size of files, the files of counters would be cut, and all that was counted before be lost.
// Tests that refuse memory (test/support/allocator.h) are not to refuse it to the counters.
#include <sys/resource.h>
#include <sys/types.h>
#include <unistd.h>

void __gcov_dump(void);
void __gcov_reset(void);
void __real__exit(int status) __attribute__((noreturn));
void __wrap__exit(int status) __attribute__((noreturn));
pid_t __wrap___gcov_fork(void);
int __wrap___gcov_execv(const char* program, char* const* arguments);
int __wrap___gcov_execvp(const char* program, char* const* arguments);
void allocator_fail_at(long number) __attribute__((weak));
void allocator_watch(void (*watch)(const void* site, long number)) __attribute__((weak));

static void lift_limit(struct rlimit* before) {
	struct rlimit limit = {RLIM_INFINITY, RLIM_INFINITY};
	getrlimit(RLIMIT_FSIZE, &limit);
	*before = limit;
	limit.rlim_cur = limit.rlim_max;
	setrlimit(RLIMIT_FSIZE, &limit);
}

// Destructors of the compiler's, which write counters, come after one without a priority.
static void __attribute__((destructor)) lift_limit_at_exit(void) {
	struct rlimit before;
	lift_limit(&before);
}

void __wrap__exit(int status) {
	lift_limit_at_exit();
	if (allocator_watch) allocator_watch(0);
	if (allocator_fail_at) allocator_fail_at(0);
	__gcov_dump();
	__real__exit(status);
}

static void write_counters(void) {
	struct rlimit before;
	lift_limit(&before);
	__gcov_dump();
	__gcov_reset();
	setrlimit(RLIMIT_FSIZE, &before);
}

// gcc calls these in place of fork, execv and execvp, and would here as well, were they not called through pointers.
static pid_t (*volatile real_fork)(void) = fork;
static int (*volatile real_execv)(const char*, char* const*) = execv;
static int (*volatile real_execvp)(const char*, char* const*) = execvp;

pid_t __wrap___gcov_fork(void) {
	write_counters();
	return real_fork();
}

int __wrap___gcov_execv(const char* program, char* const* arguments) {
	write_counters();
	return real_execv(program, arguments);
}

int __wrap___gcov_execvp(const char* program, char* const* arguments) {
	write_counters();
	return real_execvp(program, arguments);
}
