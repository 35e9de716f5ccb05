/// @file bench.h
/// The benchmark program: how a piece of work is timed, what a row of results holds, what the machine could do.
#ifndef JN_BENCHMARK_BENCH_H
#define JN_BENCHMARK_BENCH_H

#include <stdio.h>

#include "force/kernel.h"
#include "jounce/jounce.h"

/// Seconds a call: the median of several samples, the fastest and the slowest.
typedef struct Timing {
	double median, min, max;
} Timing;

/// Time run(context), which uses `threads`, after a warm-up. Short work is repeated within a sample; samples are taken for about `budget`
/// seconds, at least `least` (at most 25 of them).
Timing measure(void (*run)(void*), void* context, int threads, double budget, int least);

/// Seconds: processor time of this thread when `threads` is 1, else wall time.
double clock_for(int threads);

/// Sort `count` samples and take their median, minimum and maximum.
Timing summarize(double samples[], int count);

/// Floating-point operations that run(context) executes: a forked copy of the process is single-stepped and
/// its instructions are decoded (a fused multiply-add counts two, every lane counts). 0 where that cannot be done.
double count_flops(void (*run)(void*), void* context);

/// What rates are compared with. Names are those of the rows of group `machine`.
typedef enum Reference { FMA_PEAK, L2_READ, L3_READ, TRIAD, REFERENCES } Reference;

extern const char* const reference_names[REFERENCES];

typedef struct Bench {
	FILE* csv;
	int word_count; ///< a row is measured when its "group.name.size" contains one of the words, or there are none
	char** words;
	int threads;                     ///< 1 and this many are measured
	double reference[REFERENCES][2]; ///< flop/s or byte/s, with 1 thread and with `threads`
} Bench;

/// One line of the results. Zero members are left out.
typedef struct Row {
	const char* group; ///< machine, kernel, model or step
	const char* name;
	const char* size; ///< of the problem: "beam", "block16", a number of elements
	int threads, width;
	Timing value;     ///< in `unit`
	const char* unit; ///< "ns/element", "ms", ...
	double rate;
	const char* rate_unit;   ///< "Gflop/s", "GB/s", ...
	const char* fraction_of; ///< what `fraction` is a part of: a row of group `machine`, or "kernel"
	double fraction;
} Row;

bool bench_wants(const Bench* bench, const char* group, const char* name, const char* size);
void bench_report(const Bench* bench, const Row* row);

/// Times in seconds as a value in units of `unit` seconds, shared by `count` things.
Timing timing_in(Timing seconds, double unit, double count);

/// Make `row` say how `work` floating-point operations, or bytes, a call compare with a reference.
void row_set_flops(const Bench* bench, Row* row, double seconds, double work);
/// `resident`: bytes of the data that is touched again and again, which tell the memory that it stays in.
void row_set_bytes(const Bench* bench, Row* row, double seconds, double bytes, double resident);

// ---- the groups ----

/// Measure what the machine can do into bench->reference, and report it.
void bench_machine(Bench* bench);
void bench_kernels(const Bench* bench);
/// Assembly, products and the direct solver, on whole models.
JnStatus bench_models(const Bench* bench);
JnStatus bench_steps(const Bench* bench);
/// Steps of the smallest models.
JnStatus bench_small(const Bench* bench);
/// Small explicit steps of threads.
JnStatus bench_threads(const Bench* bench);
/// Peridynamic bonds without a matrix.
JnStatus bench_bonds(const Bench* bench);
/// Contact solvers on the problems that scenes make.
JnStatus bench_contact(const Bench* bench);
/// Forces, products, solves and steps of blocks from 2,000 to 824,000 unknowns.
JnStatus bench_scaling(const Bench* bench);
/// Its rows of whole steps, of the scene of one size.
JnStatus bench_scaling_steps(const Bench* bench, const char* size, int steps, int threads);

// ---- shared pieces ----

/// What kernels do; those behind DEFINITE where they have it. Products of constraints are those of the definite form, as
/// damping takes them.
typedef enum Verb { ENERGY, FORCE, TANGENT, DEFINITE, PRODUCT, STORE, PRODUCT_SINGLE, DIAGONAL, VERBS } Verb;

extern const char* const verb_names[VERBS];

/// A kernel run over a group in the chunks that the assembly uses.
typedef struct KernelRun {
	const JnGroup* group;
	int batches; ///< of the group, from the first
	const double* x;
	double* out;   ///< KERNEL_RUN_REALS
	float* stored; ///< of STORE and PRODUCT_SINGLE: stored_reals[0] floats a point
	float* single; ///< of PRODUCT_SINGLE: a direction with 4 numbers a node
	Verb verb;
} KernelRun;

enum { KERNEL_RUN_REALS = 16 * 55 * 9 };

void kernel_run(void* context);

/// A deformed copy of rest positions in `x`: turned by 0.3 rad, bent, and every coordinate moved by up to 5 % of `edge`.
void deform(int node_count, const double* rest, double edge, double* x);

/// Where the scene of `size` is, and what to set in it: "beam", "cloth" or another scene's name, or "block<n>" with n^3
/// hexahedra.
typedef struct SceneOf {
	char path[512];
	char cells[64];
	int set_count;
} SceneOf;

SceneOf scene_of(const char* size);

#endif
