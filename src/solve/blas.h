/// @file blas.h
/// The dense kernels below CHOLMOD. Debian's OpenBLAS 0.3.21 takes newer Xeons for a Prescott (SSE3) and is then several
/// times slower; its kernels are chosen when the library is loaded, so the remedy is an environment variable set before.
#ifndef JN_SOLVE_BLAS_H
#define JN_SOLVE_BLAS_H

#include "jounce/base.h"

/// One thread in the dense kernels: fronts are small, and two pools of threads fight for the same cores.
void jn_blas_prepare(void);

/// Write the library's name and kernels, such as "OpenBLAS 0.3.21 SkylakeX", into out[size].
void jn_blas_name(char* out, size_t size);

/// The value of OPENBLAS_CORETYPE with which the process should have been started, when the library mistook the
/// processor; NULL when its choice is sane.
const char* jn_blas_better_core(void);

/// Two libraries read the environment when they are loaded, before main; where it lacks what serves us, start the program
/// again with it: OPENBLAS_CORETYPE when OpenBLAS mistook the processor, OPENBLAS_NUM_THREADS=1, and OMP_WAIT_POLICY=passive,
/// because threads that spin while they wait make a step on a busy machine several times slower. For programs, as the first
/// call in main; what the user has set stays.
void jn_blas_restart(char** arguments);

#endif
