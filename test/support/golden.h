/// @file golden.h
/// Fingerprints of short runs of the scenes: the bits of all positions and velocities at the start and after some steps.
#ifndef JN_TEST_SUPPORT_GOLDEN_H
#define JN_TEST_SUPPORT_GOLDEN_H

#include <stdbool.h>
#include <stdio.h>

/// Whose linear systems are solved how.
typedef enum GoldenSolver {
	GOLDEN_FILE, ///< as the scene's file says
	GOLDEN_CG,   ///< conjugate gradients with the blocks of nodes: no dense kernels of OpenBLAS in linear systems
	GOLDEN_SOLVERS
} GoldenSolver;

/// One row of test/reference/golden.csv.
typedef struct GoldenRow {
	char scene[32];
	const char* solver;
	char blas[96]; ///< library and kernels that were there; in the file "any" where those do not count
	char libm[17]; ///< fingerprint of what the C library's sin, cos, pow and others return; or "any"
	long steps;    ///< accepted
	char start[33], end[33];
} GoldenRow;

/// Where threads have a part in the smallest model and sleep while they wait: starts the program again unless the environment
/// says so already. The first call in main.
void golden_prepare(char** arguments);

/// The scenes of a folder, but those called *_large; `paths` is NULL-terminated and lives as long as the program.
char** golden_scenes(const char* folder);

/// Run a scene for 1 / `part` of the steps of the file. False: the scene refuses the solver. The test fails when a step does,
/// or when the end is not finite.
bool golden_run(const char* path, GoldenSolver solver, int threads, int part, GoldenRow* row);

/// The test fails unless all scenes end with the same bits with one thread and with `threads`.
void golden_check_threads(int threads, int part);

void golden_print_header(FILE* out);
void golden_print(FILE* out, const GoldenRow* row);

/// The same bits?
bool golden_is_same(const GoldenRow* a, const GoldenRow* b);

/// `PROGRAM --print [--threads N] [--scenes FOLDER] [WORD ...]`: write the rows of scenes whose names contain a word, or of
/// all, and return the exit status. `count` and `arguments` are those of main.
int golden_main(int count, char** arguments);

#endif
