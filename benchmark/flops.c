// Counts floating-point operations without hardware counters, which virtual machines rarely offer: a child process runs
// the work one instruction at a time (ptrace), and each instruction is looked up by its encoding.
//   VEX, EVEX or SSE prefix -> opcode map, operand prefix (none: packed floats, 66: packed doubles, F3 and F2: one of them), vector length
#include "bench.h"

#if defined(__x86_64__) && defined(__linux__)
	#include <signal.h>
	#include <sys/ptrace.h>
	#include <sys/user.h>
	#include <sys/wait.h>
	#include <unistd.h>

typedef struct Instruction {
	int map;      // 1: 0F, 2: 0F 38, 3: 0F 3A; 0: none of these
	int prefix;   // 0 none, 1: 66, 2: F3, 3: F2
	int length;   // lanes of packed doubles: 2, 4 or 8; half as many as of floats
	bool is_wide; // W bit: doubles
	uint8_t opcode;
} Instruction;

static Instruction decode_sse(const uint8_t* p) {
	Instruction out = {.length = 2};
	for (;; ++p) {
		if (*p == 0x66)
			out.prefix = 1;
		else if (*p == 0xF3)
			out.prefix = 2;
		else if (*p == 0xF2)
			out.prefix = 3;
		else if ((*p & 0xF0) != 0x40) // REX
			break;
	}
	if (p[0] != 0x0F) return out;
	out.map = p[1] == 0x38 ? 2 : p[1] == 0x3A ? 3 : 1;
	out.opcode = out.map == 1 ? p[1] : p[2];
	return out;
}

static Instruction decode(const uint8_t* p) {
	switch (p[0]) {
	case 0xC5:
		return (Instruction){1, p[1] & 3, 2 << (p[1] >> 2 & 1), false, p[2]};
	case 0xC4:
		return (Instruction){p[1] & 31, p[2] & 3, 2 << (p[2] >> 2 & 1), p[2] >> 7, p[3]};
	case 0x62: // EVEX; with a rounding mode of its own the length is always 512 bits, which compilers do not emit here
		return (Instruction){p[1] & 7, p[2] & 3, 2 << (p[3] >> 5 & 3), p[2] >> 7, p[4]};
	default:
		return decode_sse(p);
	}
}

static bool is_arithmetic(uint8_t opcode) { // sqrt, add, mul, sub, div
	return opcode == 0x51 || opcode == 0x58 || opcode == 0x59 || opcode == 0x5C || opcode == 0x5E;
}

static int flops_of(Instruction in) {
	if (in.map == 1 && is_arithmetic(in.opcode)) return in.prefix == 0 ? 2 * in.length : in.prefix == 1 ? in.length : 1;
	const int row = in.opcode >> 4, column = in.opcode & 15;
	const bool is_fma = in.map == 2 && in.prefix == 1 && row >= 9 && row <= 11 && column >= 6;
	if (!is_fma) return 0;
	return column >= 8 && column % 2 == 1 ? 2 : (in.is_wide ? 2 : 4) * in.length;
}

static double follow(pid_t child) {
	double sum = 0;
	int status = 0;
	while (waitpid(child, &status, 0) == child && WIFSTOPPED(status)) {
		struct user_regs_struct registers;
		const bool is_known = ptrace(PTRACE_GETREGS, child, NULL, &registers) == 0;
		if (is_known) sum += flops_of(decode((const uint8_t*)registers.rip)); // the child's code is ours, where ours is
		if (!is_known || ptrace(PTRACE_SINGLESTEP, child, NULL, NULL) != 0) kill(child, SIGKILL);
	}
	return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? sum : 0;
}

double count_flops(void (*run)(void*), void* context) {
	run(context); // so that lazily bound functions are bound
	fflush(NULL);
	const pid_t child = fork();
	if (child < 0) return 0;
	if (child == 0) {
		if (ptrace(PTRACE_TRACEME, 0, NULL, NULL) != 0) _exit(1);
		raise(SIGSTOP);
		run(context);
		_exit(0);
	}
	return follow(child);
}
#else
double count_flops(void (*run)(void*), void* context) {
	(void)run, (void)context;
	return 0;
}
#endif
