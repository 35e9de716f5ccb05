/// @file base.h
/// What every other header builds on: status codes, messages, vectors, the state of a simulation.
#ifndef JOUNCE_BASE_H
#define JOUNCE_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define JN_VERSION "0.1.0"

/// What became of a call. 0 works; above 0 is an outcome that a step controller handles; below 0 ends the run.
typedef enum JnStatus {
	JN_OK = 0,
	JN_NOT_CONVERGED = 1,  ///< an iteration did not reach its tolerance
	JN_INDEFINITE = 2,     ///< a matrix that must be positive definite is not
	JN_NOT_FINITE = 3,     ///< a force, position or velocity is infinite or NaN
	JN_BAD_INPUT = -1,     ///< the user's file or arguments are wrong; the message says where
	JN_IO_FAILED = -2,     ///< a file could not be read or written
	JN_OUT_OF_MEMORY = -3, ///< an allocation failed
	JN_RUN_FAILED = -4,    ///< the simulation could not go on; the last good state is kept
} JnStatus;

/// Return early with the status of `expression` unless it is JN_OK.
#define JN_TRY(expression)                                                                                             \
	do {                                                                                                               \
		const JnStatus jn_try_status = (expression);                                                                   \
		if (jn_try_status != JN_OK) return jn_try_status;                                                              \
	} while (0)

/// A short name for a status, such as "not converged". Static storage.
const char* jn_status_name(JnStatus status);

typedef enum JnLogLevel { JN_LOG_ERROR, JN_LOG_WARNING, JN_LOG_INFO } JnLogLevel;

/// Receives every message of the library; `message` is one or more lines without a final newline, valid during the call.
typedef void (*JnLogSink)(void* user, JnLogLevel level, const char* message);

/// Send messages to `sink`; NULL restores the default, which writes errors and warnings to stderr. Not thread-safe.
void jn_log_set_sink(JnLogSink sink, void* user);

/// Three doubles a node, `3 * node_count` long, for the host space. Device spaces keep their own memory behind it.
typedef double* JnVec;

/// A scaled vector, one term of a sum.
typedef struct JnTerm {
	double scale;
	const double* vec;
} JnTerm;

/// The state of a system at a time. Plain data; vectors belong to the space that created them.
typedef struct JnState {
	double t;       ///< time [s]
	JnVec x, v;     ///< positions [m] and velocities [m/s]
	uint64_t stamp; ///< renewed by jn_state_touch() at every edit of t or x; equal stamps mean equal t and x
} JnState;

/// How a linear system was solved: with a factor, or by conjugate gradients with a preconditioner.
typedef enum JnWay {
	JN_WAY_DIRECT,     ///< sparse Cholesky factor of the matrix
	JN_WAY_PLAIN,      ///< no preconditioner
	JN_WAY_BLOCK,      ///< the inverse diagonal blocks
	JN_WAY_KEPT,       ///< a factor of an earlier matrix, carried along by the rotations of the nodes
	JN_WAY_INCOMPLETE, ///< an incomplete factor
	JN_WAY_MULTIGRID,
	JN_WAY_COUNT
} JnWay;

/// Its word in scene files and statistics.
const char* jn_way_name(JnWay way);

/// What one step, or one attempt, has cost. Counts, summed over its stages.
typedef struct JnReport {
	int newton;               ///< Newton iterations
	int forces;               ///< evaluations of f
	int tangents;             ///< assemblies of K
	int factorizations;       ///< numeric factorisations
	int solves;               ///< solves with a factor
	int iterations;           ///< of those solves, where the linear solver iterates
	int served[JN_WAY_COUNT]; ///< those solves again, by their way
	int changes;              ///< from one way to another
	int indefinite;           ///< Newton matrices that were indefinite and were replaced by the definite form
	int backtracks;           ///< halvings in the line search
	int minimized;            ///< stages that newton.mode auto handed over from root to minimize
	int rejected;             ///< attempts thrown away before this one
	double error;    ///< embedded estimate of the step's error in position, largest entry [m]; 0: the method has none
	double residual; ///< residual norm at the end of the last stage, relative to the force scale
	double seconds_predict; ///< wall time of the integrator [s]
	double seconds_detect;  ///< of finding contacts and making rows of them [s]
	double seconds_factor;  ///< of contact's matrices, filled and factored [s]
	double seconds_qp;      ///< of contact's quadratic programs, the rest of a correction [s]
} JnReport;

#ifdef __cplusplus
}
#endif
#endif
