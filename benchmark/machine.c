// What the machine can do: multiply-adds from registers, reading from the caches, STREAM's triad from memory
// (McCalpin 1995: a = b + s c, 24 bytes an element), and the dense product below the sparse factorisation.
#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#if defined(__x86_64__)
	#include <immintrin.h>
#endif

#include "bench.h"
#include "solve/blas.h"

enum { CHAINS = 12, ROUNDS = 200000 }; // two units with a latency of four need eight independent chains
enum { MOST_THREADS = 256 };
static const double least_bytes = 32e6; // that a call reads, so that waking threads is lost in it

// Multiply-add chains, and a sum over memory, for one vector width.
#define DEFINE_UNIT(width, target_attribute, multiply_add)                                                             \
	typedef double Lanes##width __attribute__((vector_size(8 * (width)), may_alias));                                  \
	target_attribute static double chains_##width(double seed) {                                                       \
		Lanes##width sum[CHAINS], factor = {0}, shift = {0};                                                           \
		_Pragma("GCC unroll 16") for (int i = 0; i < CHAINS; i++) sum[i] = factor + seed * (i + 1);                    \
		factor += 1 - seed;                                                                                            \
		shift += seed;                                                                                                 \
		for (int round = 0; round < ROUNDS; round++) {                                                                 \
			_Pragma("GCC unroll 16") for (int i = 0; i < CHAINS; i++) sum[i] = multiply_add(sum[i], factor, shift);    \
		}                                                                                                              \
		_Pragma("GCC unroll 16") for (int i = 1; i < CHAINS; i++) sum[0] += sum[i];                                    \
		return sum[0][0];                                                                                              \
	}                                                                                                                  \
	target_attribute static double read_##width(const double* data, size_t count) {                                    \
		const Lanes##width* from = (const void*)data;                                                                  \
		Lanes##width sum[8] = {{0}};                                                                                   \
		for (size_t k = 0; k + 8 <= count / (width); k += 8) {                                                         \
			_Pragma("GCC unroll 16") for (int i = 0; i < 8; i++) sum[i] += from[k + (size_t)i];                        \
		}                                                                                                              \
		_Pragma("GCC unroll 16") for (int i = 1; i < 8; i++) sum[0] += sum[i];                                         \
		return sum[0][0];                                                                                              \
	}

#define MULTIPLY_THEN_ADD(a, b, c) ((a) * (b) + (c))
DEFINE_UNIT(2, , MULTIPLY_THEN_ADD)
#if defined(__x86_64__)
DEFINE_UNIT(4, __attribute__((target("avx2,fma"))), _mm256_fmadd_pd)
DEFINE_UNIT(8, __attribute__((target("avx512f"))), _mm512_fmadd_pd)
#endif

typedef struct Work {
	int threads, width;
	size_t count;               // doubles a thread
	int passes;                 // over them
	double* data[MOST_THREADS]; // one array a thread
	double *a, *b, *c;          // of the triad, shared
	volatile double result;
} Work;

static double run_chains(int width) {
#if defined(__x86_64__)
	if (width == 8) return chains_8(1e-9);
	if (width == 4) return chains_4(1e-9);
#endif
	(void)width;
	return chains_2(1e-9);
}

static double run_read(int width, const double* data, size_t count) {
#if defined(__x86_64__)
	if (width == 8) return read_8(data, count);
	if (width == 4) return read_4(data, count);
#endif
	(void)width;
	return read_2(data, count);
}

static void all_chains(void* context) {
	Work* work = context;
	double sum = 0;
#pragma omp parallel for num_threads(work->threads) reduction(+ : sum) schedule(static, 1)
	for (int t = 0; t < work->threads; t++) sum += run_chains(work->width);
	work->result = sum;
}

static void all_reads(void* context) {
	Work* work = context;
	double sum = 0;
#pragma omp parallel for num_threads(work->threads) reduction(+ : sum) schedule(static, 1)
	for (int t = 0; t < work->threads; t++)
		for (int pass = 0; pass < work->passes; pass++) sum += run_read(work->width, work->data[t], work->count);
	work->result = sum;
}

static void triad(void* context) {
	Work* work = context;
	double *a = work->a, *b = work->b, *c = work->c;
#pragma omp parallel for num_threads(work->threads) schedule(static)
	for (size_t k = 0; k < work->count; k++) a[k] = b[k] + 3.0 * c[k];
}

static void report(const Bench* bench, const char* name, const char* size, const Work* work, Timing seconds,
				   double amount, const char* unit) {
	const Row row = {.group = "machine",
					 .name = name,
					 .size = size,
					 .threads = work->threads,
					 .width = work->width,
					 .value = timing_in(seconds, 1e-3, 1),
					 .unit = "ms",
					 .rate = amount / seconds.median * 1e-9,
					 .rate_unit = unit};
	if (bench_wants(bench, "machine", name, size)) bench_report(bench, &row);
}

static void measure_peak(Bench* bench, int width, int many) {
	Work work = {.threads = many ? bench->threads : 1, .width = width};
	const Timing seconds = measure(all_chains, &work, work.threads, 0.15, 5);
	const double flops = 2.0 * CHAINS * ROUNDS * width * work.threads;
	if (width == jn_kernel_best_width()) bench->reference[FMA_PEAK][many] = flops / seconds.min;
	report(bench, "fma_peak", "registers", &work, seconds, flops, "Gflop/s");
}

static void fill(double* data, size_t count, double number) {
	for (size_t k = 0; k < count; k++) data[k] = number;
}

// Each thread reads `bytes` of its own again and again.
static void measure_read(Bench* bench, Reference reference, size_t bytes, int many) {
	Work work = {.threads = many ? bench->threads : 1, .width = jn_kernel_best_width()};
	work.count = bytes / sizeof(double) / 64 * 64;
	work.passes = 1 + (int)(least_bytes / (double)bytes);
	bool is_complete = true;
	for (int t = 0; t < work.threads; t++) {
		work.data[t] = aligned_alloc(64, work.count * sizeof(double));
		if (work.data[t] == NULL)
			is_complete = false;
		else
			fill(work.data[t], work.count, 1);
	}
	char size[24];
	snprintf(size, sizeof size, "%.3gMB", 1e-6 * (double)bytes);
	if (is_complete) {
		const Timing seconds = measure(all_reads, &work, work.threads, 0.2, 5);
		const double moved = (double)(work.count * sizeof(double)) * work.threads * work.passes;
		bench->reference[reference][many] = moved / seconds.min;
		report(bench, reference_names[reference], size, &work, seconds, moved, "GB/s");
	}
	for (int t = 0; t < work.threads; t++) free(work.data[t]);
}

static void measure_triad(Bench* bench, int many) {
	Work work = {.threads = many ? bench->threads : 1, .width = 2, .count = (size_t)1 << 25};
	work.a = aligned_alloc(64, work.count * sizeof(double));
	work.b = aligned_alloc(64, work.count * sizeof(double));
	work.c = aligned_alloc(64, work.count * sizeof(double));
	if (work.a != NULL && work.b != NULL && work.c != NULL) {
		fill(work.a, work.count, 0);
		fill(work.b, work.count, 1);
		fill(work.c, work.count, 2);
		const Timing seconds = measure(triad, &work, work.threads, 0.5, 5);
		const double moved = 3.0 * sizeof(double) * (double)work.count;
		bench->reference[TRIAD][many] = moved / seconds.min;
		report(bench, "triad", "3x268MB", &work, seconds, moved, "GB/s");
	}
	free(work.a);
	free(work.b);
	free(work.c);
}

typedef struct Product {
	int n;
	double *a, *b, *c;
} Product;

static void dgemm(void* context) {
	const Product* p = context;
	cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, p->n, p->n, p->n, -1, p->a, p->n, p->b, p->n, 1, p->c, p->n);
}

static void warn_of_slow_kernels(const Bench* bench, double rate) {
	char blas[96];
	jn_blas_name(blas, sizeof blas);
	const double share = rate / bench->reference[FMA_PEAK][0];
	if (share >= 0.4) return;
	fprintf(stderr,
			"note: dgemm reaches %.0f %% of the multiply-add peak with %s; a BLAS whose kernels fit the "
			"processor reaches more than 40 %% (OPENBLAS_CORETYPE chooses them)\n",
			100 * share, blas);
}

static void measure_product(const Bench* bench, int n) {
	const size_t entries = (size_t)n * (size_t)n;
	Product p = {.n = n};
	double* memory = aligned_alloc(64, 3 * entries * sizeof *memory);
	char size[24];
	snprintf(size, sizeof size, "%d", n);
	if (memory == NULL || !bench_wants(bench, "machine", "dgemm", size)) {
		free(memory);
		return;
	}
	fill(memory, 3 * entries, 1e-3);
	p.a = memory;
	p.b = memory + entries;
	p.c = memory + 2 * entries;
	const Timing seconds = measure(dgemm, &p, 1, 0.4, 5);
	Row row = {.group = "machine", .name = "dgemm", .size = size, .threads = 1, .unit = "ms"};
	row.value = timing_in(seconds, 1e-3, 1);
	row_set_flops(bench, &row, seconds.median, 2.0 * n * (double)entries);
	bench_report(bench, &row);
	if (n > 1000) warn_of_slow_kernels(bench, row.rate * 1e9);
	free(memory);
}

static size_t cache_bytes(int name, size_t otherwise) {
	const long bytes = sysconf(name);
	return bytes > 0 ? (size_t)bytes : otherwise;
}

void bench_machine(Bench* bench) {
	const size_t l2 = cache_bytes(_SC_LEVEL2_CACHE_SIZE, 1 << 20), l3 = cache_bytes(_SC_LEVEL3_CACHE_SIZE, 16 << 20);
	const size_t in_l3 = l3 / 4 < 4 * l2 ? 4 * l2 : l3 / 4;
	for (int many = 0; many < (bench->threads > 1 ? 2 : 1); many++) {
		for (int width = 2; width <= jn_kernel_best_width(); width *= 2) measure_peak(bench, width, many);
		measure_read(bench, L2_READ, l2 / 2, many);
		measure_read(bench, L3_READ, in_l3, many);
		measure_triad(bench, many);
	}
	jn_blas_prepare();
	measure_product(bench, 96);
	measure_product(bench, 2048);
}
