// The benchmark of jounce: what the machine can do, the element kernels, assembly and solver, whole steps.
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/parallel.h"
#include "bench.h"
#include "solve/blas.h"

#if defined(__clang__)
	#define COMPILER ""
#else
	#define COMPILER "gcc"
#endif

static const char help[] =
	"usage: jounce_bench [--csv FILE] [--threads N] [WORD ...]\n\n"
	"Measures the rows whose group.name.size contains one of the words, or all of them (about 4 minutes), and prints\n"
	"medians with [fastest, slowest]. Groups: machine, kernel, model, step, thread, bond, qp, scaling. Sizes of model "
	"and step: beam, block16, block32; of models also cloth and block64, of scaling block8 to block64.\n\n"
	"  --csv FILE   write the rows there too\n"
	"  --threads N  threads to compare with one; the processors there are unless given\n";

// The processor as the system names it.
static void processor_name(char* out, size_t size) {
	char line[256];
	snprintf(out, size, "unknown");
	FILE* file = fopen("/proc/cpuinfo", "r");
	while (file != NULL && fgets(line, sizeof line, file) != NULL) {
		if (strncmp(line, "model name", 10) != 0) continue;
		const char* colon = strchr(line, ':');
		if (colon != NULL) snprintf(out, size, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2);
		break;
	}
	if (file != NULL) fclose(file);
}

static void write_header(FILE* out) {
	char processor[128], blas[96], date[16];
	const time_t now = time(NULL);
	processor_name(processor, sizeof processor);
	jn_blas_name(blas, sizeof blas);
	strftime(date, sizeof date, "%Y-%m-%d", localtime(&now));
	fprintf(out, "# processor: %s, %ld cores, L2 %ld KiB, L3 %ld KiB\n", processor, sysconf(_SC_NPROCESSORS_ONLN),
			sysconf(_SC_LEVEL2_CACHE_SIZE) / 1024, sysconf(_SC_LEVEL3_CACHE_SIZE) / 1024);
	fprintf(out,
			"# vector width: %d doubles\n# compiler: " COMPILER
			" %s\n# blas: %s, one thread\n# jounce: %s\n# clock: processor time "
			"with one thread, wall time with more\n# date: %s\n",
			jn_kernel_best_width(), __VERSION__, blas, JN_VERSION, date);
}

SceneOf scene_of(const char* size) {
	SceneOf out = {0};
	const bool is_block = strncmp(size, "block", 5) == 0;
	snprintf(out.path, sizeof out.path, "%s/%s%s.yaml", JN_SOURCE_DIR, is_block ? "benchmark/scenes/" : "scenes/",
			 is_block ? "block" : size);
	if (!is_block) return out;
	const int n = atoi(size + 5);
	snprintf(out.cells, sizeof out.cells, "bodies[0].shape.cells=[%d,%d,%d]", n, n, n);
	out.set_count = 1;
	return out;
}

static JnStatus run_groups(Bench* bench) {
	write_header(stdout);
	if (bench->csv != NULL) {
		write_header(bench->csv);
		fputs("group,name,size,threads,width,median,min,max,unit,rate,rate_unit,fraction_of,fraction\n", bench->csv);
	}
	bench_machine(bench);
	bench_kernels(bench);
	JN_TRY(bench_models(bench));
	JN_TRY(bench_steps(bench));
	JN_TRY(bench_small(bench));
	JN_TRY(bench_threads(bench));
	JN_TRY(bench_bonds(bench));
	JN_TRY(bench_contact(bench));
	return bench_scaling(bench);
}

static int usage_error(const char* words) {
	fprintf(stderr, "jounce_bench: %s\n%s", words, help);
	return 2;
}

int main(int count, char** arguments) {
	jn_blas_restart(arguments);
	Bench bench = {.threads = jn_threads_available(), .words = arguments};
	const char* path = NULL;
	for (int i = 1; i < count; ++i) {
		if (strcmp(arguments[i], "--help") == 0) return fputs(help, stdout), 0;
		const bool is_csv = strcmp(arguments[i], "--csv") == 0, is_threads = strcmp(arguments[i], "--threads") == 0;
		if (strncmp(arguments[i], "--", 2) != 0)
			arguments[bench.word_count++] = arguments[i];
		else if ((!is_csv && !is_threads) || i + 1 == count)
			return usage_error("an option is unknown or lacks its value");
		else if (is_csv)
			path = arguments[++i];
		else
			bench.threads = atoi(arguments[++i]);
	}
	if (bench.threads < 1 || bench.threads > 256) return usage_error("--threads takes a number from 1 to 256");
	if (path != NULL && (bench.csv = fopen(path, "w")) == NULL) return perror(path), 3;
	const JnStatus status = run_groups(&bench);
	if (bench.csv != NULL && fclose(bench.csv) != 0) return perror(path), 3;
	return status == JN_OK ? 0 : 1;
}
