/// @file extend.h
/// The structs of verbs behind which everything exchangeable lives: key tables, spaces, systems, matrices,
/// integrators, controllers. Include this to add a method, a law, a controller or a system of your own.
#ifndef JOUNCE_EXTEND_H
#define JOUNCE_EXTEND_H

#include "jounce/archive.h"
#include "jounce/base.h"

#ifdef __cplusplus
extern "C" {
#endif

// ---- keys: one row describes, parses, checks and documents one entry of a scene file ----

/// What a key holds, and the type of the field that receives it.
typedef enum JnKind {
	JN_REAL,    ///< double; converted to the key's SI unit
	JN_INTEGER, ///< int
	JN_SWITCH,  ///< bool: true, false, yes, no, on, off
	JN_TEXT,    ///< const char*, owned by the scene; NULL when there is neither value nor default
	JN_PATH,    ///< like JN_TEXT, a file: a relative path is taken from the folder of the scene file that says it, and
	///< from the current folder in an override
	JN_REAL2,    ///< double[2], each with the key's unit; NAN in both when absent without default
	JN_INTEGER2, ///< int[2]
	JN_REAL3,    ///< double[3], each with the key's unit; NAN in all three when absent without default
	JN_INTEGER3, ///< int[3]
	JN_POINTS,   ///< JnPoints: a list of [time, value] pairs; times in s, values in the key's unit
	JN_CHOICE,   ///< int: index into the NULL-terminated .names
	JN_OBJECT,   ///< a nested struct with its own .keys, filled with defaults when absent
	JN_OPTIONAL, ///< pointer to a nested struct with .keys and .size; NULL when absent
	JN_LIST,     ///< JnItems: a list of nested structs with .keys and .size; with .rows: of JnVariant
	JN_VARIANT,  ///< JnVariant: the row of .rows that the entry .tag names, with that row's own keys beside it
} JnKind;

typedef enum JnOpen {
	JN_CLOSED = 0,
	JN_OPEN_LOW = 1,
	JN_OPEN_HIGH = 2
} JnOpen; ///< which bounds are themselves outside

typedef struct JnKey JnKey;

/// The head of every row of a catalogue (an integrator, a law, a shape, a controller): first member of its struct.
typedef struct JnRow {
	const char* name;    ///< as written in scene files
	const char* doc;     ///< one sentence
	const JnKey* keys;   ///< the row's own keys, ended by a row without name; NULL: none
	size_t options_size; ///< bytes of the struct that those keys fill
} JnRow;

/// A catalogue: all rows that may stand in one place.
typedef struct JnRowList {
	const char* noun;         ///< singular, such as "integrator"; used in messages
	const JnRow* const* rows; ///< `count` rows
	int count;
} JnRowList;

/// The value of a JN_VARIANT: the chosen row, and its options (row->options_size bytes; NULL if that is 0).
typedef struct JnVariant {
	const JnRow* row; ///< NULL when the key is absent and has no default
	void* options;
} JnVariant;

/// The value of a JN_LIST: `count` structs, one behind the other.
typedef struct JnItems {
	int count;
	void* data;
} JnItems;

/// The value of a JN_POINTS.
typedef struct JnPoints {
	int count;
	double (*data)[2]; ///< [time in s, value in SI], in file order
} JnPoints;

/// One row a key: gives parsing with units, default, bounds, messages, `jounce describe` and the reference page.
/// A table of keys ends with a row whose name is NULL.
struct JnKey {
	const char* name;
	JnKind kind;
	size_t field;        ///< offsetof the field in the struct that the table fills
	double value[3];     ///< default of REAL, INTEGER, SWITCH, CHOICE (index) and lists of 2 or 3; ignored if required
	const char* text;    ///< default of TEXT, or the name of the default row of a VARIANT; NULL: none
	double low, high;    ///< inclusive bounds of numbers (each component), SI; both 0: unbounded
	JnOpen open;         ///< bounds that are exclusive
	bool required;       ///< must be given in the file
	bool absent_allowed; ///< REAL, REAL2, REAL3: default is NAN, meaning "not given"
	const char* unit;    ///< SI unit such as "m/s^2"; NULL or "": a pure number
	const char* const* names; ///< CHOICE: the words, NULL at the end
	const JnKey* keys;        ///< OBJECT, OPTIONAL, LIST: keys of the nested struct
	size_t size;              ///< OPTIONAL, LIST: bytes of the nested struct
	const JnRowList* rows;    ///< VARIANT, and LIST of variants: the catalogue
	const char* tag;          ///< with .rows: the entry that names the row, such as "method"
	const char* remedy;  ///< what to do about a value outside its bounds, such as "use 0.49 for nearly incompressible"
	const char* meaning; ///< one sentence or phrase, for describe and the reference page
};

// ---- space: where vectors live ----

typedef struct JnSpace JnSpace;

/// The algebra of vectors. All reductions run in an order that does not depend on the number of threads.
typedef struct JnSpaceOps {
	JnVec (*create)(JnSpace*);        ///< zeroed; NULL when memory is out
	void (*destroy)(JnSpace*, JnVec); ///< NULL is allowed
	void (*combine)(JnSpace*, JnVec out, int count,
					const JnTerm terms[]); ///< out = sum of scale * vec, up to 16 terms; out may be one
	double (*dot)(JnSpace*, const double* a, const double* b);
	double (*max)(JnSpace*, const double* a);     ///< largest absolute entry; NAN if any is NAN
	double (*longest)(JnSpace*, const double* a); ///< largest length of a node's entries; NAN if any is NAN
} JnSpaceOps;

struct JnSpace {
	const JnSpaceOps* ops;
	size_t length;       ///< entries of a vector
	int node_entries;    ///< entries that belong to one node: 3 in models, 1 (or 0, which counts as 1) elsewhere
	int threads;         ///< threads that a vector operation may use
	uint64_t last_stamp; ///< stamps handed out so far
};

/// Renew the stamp of `s` after its time, positions or velocities have been edited.
static inline void jn_state_touch(JnSpace* space, JnState* s) {
	s->stamp = ++space->last_stamp;
}

// ---- system: M a = f(t, x, v), all that an integrator may know ----

typedef struct JnSystem JnSystem;
typedef struct JnMatrix JnMatrix;

/// The coefficients of mass M + damping D + stiffness K.
typedef struct JnShift {
	double mass, damping, stiffness;
} JnShift;

typedef struct JnMatrixOps {
	void (*apply)(JnMatrix*, const double* in, JnVec out);      ///< out = matrix * in, held entries included
	JnStatus (*solve)(JnMatrix*, const double* rhs, JnVec out); ///< factors on first use; held entries of out are 0
	/// Like solve and faster: a direction for iterations that measure their residual. |rhs - matrix out| need not be below
	/// tolerance |rhs|, and is never asked to be below 1e-6 |rhs|. NULL: use solve.
	JnStatus (*approximate)(JnMatrix*, double tolerance, const double* rhs, JnVec out);
} JnMatrixOps;

struct JnMatrix {
	const JnMatrixOps* ops;
	JnSystem* sys;
	bool is_factored;    ///< a solve needs no new factorisation
	double refresh_cost; ///< cost of a new tangent and factorisation, in iterations that use a kept one
	/// Solves are iterations that cost by their tolerance, and a new tangent costs next to nothing beside them. May change
	/// from solve to solve.
	bool is_iterative;
};

typedef struct JnSystemOps {
	JnStatus (*begin)(JnSystem*, const JnState* start);      ///< freeze damping, rotations, friction lag
	void (*prescribe)(JnSystem*, JnState* s, JnVec a);       ///< write held nodes at s->t; a: accelerations, or NULL
	void (*hold)(JnSystem*, JnVec r);                        ///< zero the held entries of r
	JnStatus (*force)(JnSystem*, const JnState* s, JnVec f); ///< external + internal - D v [N]
	double (*energy)(JnSystem*, const JnState* s);           ///< potential [J]; NAN when there is none
	JnStatus (*linearize)(JnSystem*, const JnState* s);      ///< K and D at s; free when the stamp is known
	JnStatus (*matrix)(JnSystem*, JnShift, JnMatrix** out);  ///< of the last linearize; owned by the system
	/// Largest change of a length between neighbours, relative to their distance at rest (to 1 m where that is zero). NULL: not
	/// known; the controller stretch_limit is then refused.
	double (*stretch)(JnSystem*, const JnState* from, const JnState* to);
	/// to->v = from->v + kick M^-1 f(from), to->x = from->x + drift to->v, in one pass over the vectors; held entries become
	/// anything, t and stamp stay. `to` may be `from`. Where M is diagonal. NULL: made of force, matrix and combine.
	JnStatus (*advance)(JnSystem*, const JnState* from, double kick, double drift, JnState* to);
} JnSystemOps;

struct JnSystem {
	const JnSystemOps* ops;
	JnSpace* space;
	double
		force_scale; ///< norm of typical forces [N], against which residuals are judged; 0: taken from the forces met
	double force_floor;     ///< norm of what rounding leaves in a force [N]; residuals below it count as zero
	bool mass_is_diagonal;  ///< M^-1 is a division
	bool depends_on_time;   ///< forces or held nodes change with t at fixed x and v
	bool is_linear_in_step; ///< forces are linear in x and v between two begin()s
	bool has_potential;     ///< f = -(gradient of energy) - D v at a fixed t, D symmetric and constant over a step
	JnReport* report;       ///< where the system counts its work; set by whoever steps it, never NULL during a step
};

/// Most unknowns of a system made of callbacks: its matrices are dense.
#define JN_USER_SYSTEM_LIMIT 2000

/// Your own equations M a = f(t, x, v). Callbacks return 0, or anything else when they cannot answer (the step then fails
/// as one whose forces are not finite). All vectors have `count` entries, all matrices count * count, row by row.
typedef struct JnUserSystemDef {
	int count;  ///< unknowns, 1 .. JN_USER_SYSTEM_LIMIT
	void* user; ///< handed to every callback
	int (*force)(void* user, double t, const double* x, const double* v, double* f); ///< required
	double (*energy)(void* user, double t, const double* x);                         ///< potential; NULL: none
	/// K = -df/dx and D = -df/dv; write every entry. NULL: see tangent_product.
	int (*tangent)(void* user, double t, const double* x, const double* v, double* stiffness, double* damping);
	/// Kp and Dp, products with a vector p. NULL: K and D come from central differences of the force.
	int (*tangent_product)(void* user, double t, const double* x, const double* v, const double* p, double* stiffness_p,
						   double* damping_p);
	const double* mass;   ///< M, copied; NULL: the identity. Need not be diagonal, but explicit methods ask for that
	bool depends_on_time; ///< f changes with t at fixed x and v
} JnUserSystemDef;

/// A system of callbacks, for jn_sim_create_for. JN_BAD_INPUT after a message when the definition is unusable. Free with
/// jn_user_system_destroy, after the simulations that use it.
JnStatus jn_user_system_create(const JnUserSystemDef* def, JnSystem** sys);
void jn_user_system_destroy(JnSystem* sys);

// ---- integrators ----

typedef struct JnIntegrator JnIntegrator;
struct JnTableauProperties; // src/integrate/tableau.h

/// An attempt at a step: from `start`, which is const, to `end`, over `dt`.
typedef struct JnStep {
	JnSystem* sys;
	const JnState* start;
	JnState* end;
	double dt;
	double wanted; ///< size that the controller asked for [s]; dt is shorter where the step must end on a given time
	const struct JnIntegratorType* method; ///< for those who correct or judge the end; integrators do not read it
	bool is_edited;                        ///< a pass has corrected the end
	JnReport report;
} JnStep;

/// What a method asks of a system beyond forces.
typedef enum JnNeeds {
	JN_NEEDS_NOTHING = 0,
	JN_NEEDS_DIAGONAL_MASS = 1, ///< explicit: solves with M alone, many times
	JN_NEEDS_TANGENT = 2,       ///< linearize and matrix
} JnNeeds;

typedef struct JnIntegratorType {
	JnRow row;
	int needs;           ///< JnNeeds, combined by |
	int order;           ///< classical order
	double force_weight; ///< w in eps = w dt^2 |M^-1 (F - F~)|, for the force-error controller
	/// Follows an oscillation of which a step is half a period or more nearly exactly, so that a force held over the step moves
	/// it by twice its static displacement, or not at all: contact forces must not be carried from step to step.
	bool overshoots;
	bool keeps_tangent; ///< after a step, the system's K and D are those of its start: linearised methods
	int vectors;        ///< work vectors that a step needs
	size_t memory_size; ///< bytes of JnIntegrator.memory, without pointers; zero at the start and after a reset
	const void* table;  ///< coefficients, in the family's own form
	/// What follows from the coefficients; NULL: jn_integrator_properties measures on an oscillator instead.
	void (*properties)(const void* table, struct JnTableauProperties* out);
	/// Pure: the same start gives the same end. JN_NOT_FINITE where a position or velocity of the end is not finite.
	JnStatus (*step)(JnIntegrator*, JnStep*);
	void (*commit)(JnIntegrator*, const JnStep*); ///< keep history; NULL for one-step methods
	/// Newmark's beta, and where the accelerations at the start and at the end of the last step are; NULL: no such method.
	double (*newmark_beta)(const JnIntegrator*, const double** a0, const double** a1);
} JnIntegratorType;

/// Keys of `newton:` in a scene: how the stage problem is solved.
typedef struct JnNewtonDef {
	/// 0 root: Newton on the residual; 1 linear: one Newton step from a = 0; 2 minimize: Newton on the energy whose gradient
	/// the residual is; 3 auto: root, and minimize where it stalls
	int mode;
	double tolerance;   ///< residual norm relative to the system's force scale
	int max_iterations; ///< a stage
	int reuse;          ///< 0 auto: keep K and its factor while they serve; 1 never
	/// First guess of a stage: 0 zero; 1 the last acceleration found; 2 the line through the last two; 3 that of the same
	/// stage a step ago, moved as the last one has moved since a step ago; 4 whichever of them was nearest of late
	int guess;
} JnNewtonDef;

enum { JN_RECENT_COUNT = 4 }; ///< accelerations that an integrator keeps for first guesses

struct JnIntegrator {
	const JnIntegratorType* type;
	const void* options; ///< struct of type->row.keys, or NULL
	JnNewtonDef newton;
	JnSpace* space;
	JnVec* vectors;      ///< type->vectors of the method, behind them those of the stage solver
	void* memory;        ///< history of multistep methods
	uint64_t linearized; ///< stamp at which the kept K was made; 0: none
	uint64_t step_stamp; ///< stamp of the start of the present step
	int base_iterations; ///< of the first stage that the kept factor served; judges when it has become too old
	double excess;       ///< iterations above base_iterations since then
	double curvature;    ///< c where a Newton step leaves c |r|^2 of the residual r [1/N]; 0: not known
	int recent_count;    ///< accelerations kept for first guesses
	double recent_t[JN_RECENT_COUNT];                    ///< their times [s], the latest first
	double recent_dot[JN_RECENT_COUNT][JN_RECENT_COUNT]; ///< their dot products [m^2/s^4]
	double guess_error[4]; ///< how far guesses 0 to 3 were from the solutions of late [m/s^2]; 0: not known
};

/// Find a with  M a = w f(t, x + kx a, v + kv a) + load:  the only nonlinear problem that implicit methods have.
/// Backward Euler, Newmark, generalised alpha, BDF2 and every DIRK stage differ in kx, kv, x and v alone; HHT adds a
/// weight and a load; methods that average forces add further points.
typedef struct JnStage JnStage;
struct JnStage {
	double t, kx, kv;
	const double *x, *v;
	double weight;       ///< w; 0 stands for 1
	const double* load;  ///< [N]; NULL: none. Of the first point alone
	const double* held;  ///< accelerations of the held entries, 0 elsewhere; NULL: those prescribed at t
	const JnStage* next; ///< one more point whose weighted force is added; NULL: none
};

/// Solve a stage. On exit s is the stage state and a its acceleration [m/s^2]. Returns JN_NOT_CONVERGED, JN_INDEFINITE or JN_NOT_FINITE as outcomes.
JnStatus jn_stage_solve(JnIntegrator* integrator, JnSystem* sys, const JnStage* stage, JnState* s, JnVec a,
						JnReport* report);

// ---- controllers ----

typedef struct JnController JnController;

/// What a controller decides about an attempt.
typedef struct JnVerdict {
	bool accepted;
	double dt; ///< size of the next attempt [s]
} JnVerdict;

/// Why a run cannot go on, for the message that ends it.
typedef struct JnComplaint {
	char cause[200];  ///< what was refused in a step that worked: "the force error of 2e-4 m is above ..."; or ""
	char limit[80];   ///< what forbids a smaller step, such as "step.dt_min = 1e-6 s"; or ""
	char remedy[200]; ///< what to try: a list that follows "Try"
} JnComplaint;

typedef struct JnControllerType {
	JnRow row;
	size_t memory_size; ///< bytes of memory that survive from attempt to attempt; zeroed at the start
	int vectors;        ///< work vectors
	JnStatus (*check)(const JnController*); ///< JN_BAD_INPUT when options or method do not fit; NULL: they always do
	JnStatus (*create)(JnController*);      ///< what else it needs; NULL: nothing
	void (*destroy)(JnController*);         ///< frees what `create` made, as far as it came; NULL: nothing
	double (*first)(JnController*);         ///< size of the first step [s]
	JnStatus (*prepare)(JnController*, const JnStep*); ///< before every attempt; NULL: nothing to do
	/// Sees failed attempts too. May edit the end. JN_RUN_FAILED: the attempt is refused and no smaller one is allowed.
	JnStatus (*judge)(JnController*, JnStep*, JnStatus outcome, JnVerdict*);
	void (*explain)(const JnController*, JnComplaint*); ///< the last JN_RUN_FAILED; NULL: there is nothing to say
	/// Write or read what survives from attempt to attempt; NULL: it is `memory`, which then holds no pointers, and `vectors`.
	void (*archive)(JnController*, JnArchive*);
} JnControllerType;

struct JnController {
	const JnControllerType* type;
	const void* options; ///< struct of type->row.keys
	void* memory;
	JnIntegrator* integrator; ///< whose steps are judged
	JnSystem* sys;
	JnVec* vectors; ///< type->vectors
	char path[48];  ///< where its keys stand, such as "step" or "step.rules[1]"
};

// ---- passes: what acts on a step beside the integrator, such as contact

typedef struct JnPass JnPass;
typedef struct JnModel JnModel;

/// A number that a pass adds to the series of every step.
typedef struct JnPassColumn {
	const char *name, *unit;
	bool is_count;
} JnPassColumn;

/// Numbers of every node that a pass adds to the frames of a recording.
typedef struct JnPassField {
	const char *name, *unit;
	int components; ///< a node: 1 or 3
} JnPassField;

/// Why an attempt failed in a pass.
typedef struct JnPassComplaint {
	char cause[240];  ///< a clause behind the outcome, as "in contact of 'a' with 'b', ..."; "": it has not failed here
	char remedy[120]; ///< what to try beside a smaller step: a list behind "Try"; or ""
	int node;         ///< of the model, where that is; -1: not known
	double share;     ///< of the attempt's step, at which it should go well; 0: not known
} JnPassComplaint;

/// What happens to an attempt, in this order; each verb may be NULL:
///   prepare -> integrator -> correct, again if `correct` asks for it -> controller -> commit when it is accepted.
/// A rejected attempt leaves no trace: only `commit` changes what a pass remembers.
typedef struct JnPassType {
	JnRow row;
	size_t definition; ///< offset in JnSimDef of the pointer to its options; NULL there: this pass does not run
	bool is_always;    ///< the options themselves stand there: it runs wherever `create` finds something to do
	/// Build it for a model; *out is NULL when there is nothing to do. Messages begin with the key path.
	JnStatus (*create)(const void* options, JnModel* model, JnPass** out);
	/// Once all passes are built, in their order: find those that it works with. Messages begin with the key path.
	JnStatus (*join)(JnPass*, JnPass* const* all, int count);
	void (*destroy)(JnPass*);
	/// Before the integrator runs, for the `round`th time from this start.
	JnStatus (*prepare)(JnPass*, const JnStep*, int round);
	/// Edit the end. *edited tells whether it did; *again asks for another round. A status above 0 fails the attempt.
	JnStatus (*correct)(JnPass*, JnStep*, int round, bool* edited, bool* again);
	/// Of an accepted step. Who changes what forces depend on, as fracture does, touches the end (jn_state_touch).
	void (*commit)(JnPass*, const JnStep*);
	/// Add to `force`, 3 numbers a node, what the pass did to held nodes in the last accepted step beside the loads of the
	/// system [N]; to others it may add anything. NULL: nothing.
	void (*react)(const JnPass*, double* force);
	/// Why the last attempt failed in this pass; `out` comes empty, with node -1. NULL: it never fails.
	void (*explain)(const JnPass*, JnPassComplaint* out);
	/// Write or read what the next step and the recording of the last one depend on. What can be found again from the model
	/// and the state need not be there. NULL: nothing does.
	void (*archive)(JnPass*, JnArchive*);
	int column_count;
	const JnPassColumn* columns;
	void (*measure)(const JnPass*, double* values); ///< one a column, of the last accepted step
	int field_count;
	const JnPassField* fields;
	const double* (*field)(const JnPass*, int field); ///< components * nodes numbers of the last accepted step
} JnPassType;

struct JnPass {
	const JnPassType* type;
};

#ifdef __cplusplus
}
#endif
#endif
