// The command `jounce`: picks the subcommand.
#include <malloc.h>
#include <stdio.h>
#include <string.h>

#include "app.h"
#include "base/key.h"
#include "force/kernel.h"
#include "solve/blas.h"

typedef struct Command {
	const char* name;
	int (*run)(int count, char** arguments);
	const char* doc;
} Command;

static const Command commands[] = {
	{"run", app_run, "simulate a scene and record it"},
	{"resume", app_resume, "go on with a run that was stopped"},
	{"compare", app_compare, "run a scene in many variants and compare errors, costs and energies"},
	{"export", app_export, "write a recording for Blender, ParaView, browsers and other programs"},
	{"score", app_score, "find the largest stable step of integrators, over the time of a step"},
	{"reproduce", app_reproduce, "make figures and tables of the papers again"},
	{"mesh", app_mesh, "read, check, fill and write a mesh"},
	{"view", app_view, "show recordings in the browser"},
	{"render", app_render, "draw pictures and films of recordings, without a display"},
	{"report", app_report, "write one page about runs: pictures, curves, statistics"},
	{"check", app_check, "read and validate a scene, run nothing"},
	{"list", app_list, "show what there is: integrators, materials, elements and more"},
	{"describe", app_describe, "explain the keys of scene files"},
};
enum { COMMANDS = sizeof commands / sizeof *commands };

static const char* command_name(void* context, int index) {
	(void)context;
	return index < COMMANDS ? commands[index].name : NULL;
}

static void print_help(FILE* out) {
	fputs("jounce simulates deformable solids and makes the way it steps through time a choice.\n\n"
		  "usage: jounce COMMAND ...\n\n",
		  out);
	for (int i = 0; i < COMMANDS; ++i) fprintf(out, "  %-10s %s\n", commands[i].name, commands[i].doc);
	fputs("\n  --version  version, vector width and dense kernels in use\n  --help     this text; after a command: its "
		  "options\n\n"
		  "Start with:  jounce run scenes/beam.yaml\n\n"
		  "exit status: 0 done, or stopped by Ctrl-C with all files complete\n"
		  "             1 the simulation failed; the last good state is on disk\n"
		  "             2 bad input or usage\n             3 a file could not be read or written\n",
		  out);
}

static void print_version(void) {
	char blas[96];
	jn_blas_prepare();
	jn_blas_name(blas, sizeof blas);
	printf("jounce %s\n%d elements at once in the element loops\n%s, one thread\n", JN_VERSION, jn_kernel_best_width(),
		   blas);
}

// Factorisations take and free megabytes; giving them back to the system each time costs a sixth of a factorisation.
static void keep_freed_memory(void) {
	const int bytes = 256 << 20;
	mallopt(M_MMAP_THRESHOLD, bytes);
	mallopt(M_TRIM_THRESHOLD, bytes);
}

static int run_command(int count, char** arguments) {
	if (count < 2) return print_help(stderr), EXIT_BAD_INPUT;
	if (strcmp(arguments[1], "--help") == 0 || strcmp(arguments[1], "-h") == 0) return print_help(stdout), EXIT_DONE;
	if (strcmp(arguments[1], "--version") == 0) return print_version(), EXIT_DONE;
	for (int i = 0; i < COMMANDS; ++i)
		if (strcmp(arguments[1], commands[i].name) == 0) return commands[i].run(count - 1, arguments + 1);
	const char* near = jn_suggest(arguments[1], command_name, NULL);
	if (near != NULL) return app_usage_error("", "there is no command '%s'; did you mean '%s'?", arguments[1], near);
	return app_usage_error("", "there is no command '%s'", arguments[1]);
}

int main(int count, char** arguments) {
	jn_blas_restart(arguments);
	keep_freed_memory();
	const int status = run_command(count, arguments);
	const bool is_lost = fflush(stdout) != 0 || ferror(stdout) != 0;
	if (status != EXIT_DONE || !is_lost) return status;
	fputs("jounce: error: the output cannot be written\n", stderr);
	return EXIT_FILE_FAILED;
}
