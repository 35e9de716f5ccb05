/// @file contact.h
/// The contact pass: what it keeps, and the parts of a correction. Inside pass/ only.
///
///   find      who meets whom between the start and the end                    detect/, contact_find.c
///   rows      one row of G a contact, its bound and its friction              contact_rows.c
///   islands   bodies that contacts connect; the others are not touched        contact_island.c
///   solve     min 1/2 (v - vp)' C (v - vp) with G v >= g, by body's factors   solve/qp_*, contact_matrix.c
///   move      x = xp + theta dt (v - vp), and look again                      contact_correct.c
///   ledger    works, gaps, counters                                           contact_ledger.c
#ifndef JN_PASS_CONTACT_H
#define JN_PASS_CONTACT_H

#include "detect/detector.h"
#include "model/body_matrix.h"
#include "pass/friction.h"
#include "pass/pass.h"
#include "solve/qp_rows.h"

enum { JN_RULE_APPROACHING, JN_RULE_TOUCHING };
enum { JN_DAMPING_AUTO, JN_DAMPING_NO, JN_DAMPING_YES };
enum { JN_PREDICTION_AUTO, JN_PREDICTION_CARRIED, JN_PREDICTION_ITERATED, JN_PREDICTION_FREE };

/// Contacts as rows of G, of one attempt or of the last accepted step. Arrays grow and are kept.
typedef struct JnContactRows {
	int count;
	JnIndices indices;   ///< behind the arrays of integers
	JnNumbers numbers;   ///< behind the arrays of numbers
	int* start;          ///< count + 1, into node and weight
	int* source;         ///< number among the contacts found; in a part: of the row that was copied
	int* island;         ///< number of its island, or -1: no body of it takes part
	int* node;           ///< each node of a contact once
	double* weight;      ///< of a node's velocity in the relative velocity
	double (*frame)[9];  ///< rows n, t1, t2
	double (*bound)[3];  ///< least normal, and resting tangential relative velocity [m/s]
	double* friction;    ///< mu
	double (*lambda)[3]; ///< impulses in the frame [N s]
	double* gap;         ///< at the start [m]
	JnContact* contact;  ///< as found
	size_t contact_capacity;
} JnContactRows;

/// Contacts found in a step, in the order of the detector.
typedef struct JnContactSet {
	int count;
	JnContact* at;
	size_t capacity;
} JnContactSet;

/// What a step's contact came to.
typedef struct JnContactTally {
	int64_t pairs;
	int contacts, pressing, iterations, rounds;
	double residual;      ///< largest relative one of all islands
	double normal_work;   ///< of normal impulses, over the displacements of the step [J]
	double friction_work; ///< of tangential ones; never positive but for driven or moving surfaces [J]
	double drive_work;    ///< of driven nodes on what they touch [J]
	double loss;          ///< what contact changed in the total energy beyond these [J]
	double deepest;       ///< most negative gap at the end [m]; 0: none
} JnContactTally;

/// Sees every contact problem before it is solved, with the guess of its impulses, 3 a contact: for tests and benchmarks.
typedef void JnContactObserver(void* user, const JnContactProblem* problem, const double* guess);

typedef struct JnContactPass {
	JnPass base;
	const JnContactDef* def;
	JnModel* model;
	JnModelSystem* sys;
	JnArena arena;
	double margin; ///< [m]
	int skin_count;
	JnSkin* skins;
	int* skin_of; ///< one a body: its skin, or -1
	JnObstacle* obstacles;
	JnFriction friction;
	int *skin_surface, *obstacle_surface; ///< which row and column of it
	JnDetector* detector;
	JnBodyMatrices matrices;
	JnQp* qp;

	int prediction;          ///< of the attempt: never auto
	double theta;            ///< x = xp + theta dt (v - vp)
	JnContactSet found;      ///< in the attempt
	JnContactRows now, kept; ///< of the attempt, and of the last accepted step
	JnContactRows last;      ///< of the attempt before contacts joined
	JnContactRows part;      ///< of one island
	int* parent;             ///< one a body: islands by union and find
	int* island_of;          ///< one a body: number of its island, or -1
	int* first_node;         ///< body_count + 1
	bool *moves, *is_in;     ///< one a body: in some island; in the island at hand
	bool* is_filled;         ///< one a body: its matrix is that of the attempt
	bool* held;              ///< 3 * nodes: not in the island at hand, or held anyway
	double *free_v, *v;      ///< 3 * nodes: velocities without contact's impulses, and with them [m/s]
	double *solved, *work;   ///< 3 * nodes
	double* corrected;       ///< 3 * nodes: positions that belong to v [m]
	double *load, *tried;    ///< 3 * nodes: forces of the last accepted step, and those that act in the attempt [N]
	bool is_loaded;          ///< `tried` is not zero
	double* force;           ///< 3 * nodes: of contact in the attempt, which `load` becomes [N]
	double* gap;             ///< nodes: for recordings [m]
	bool has_failed;         ///< contact failed the last attempt,
	JnContact worst;         ///< at this one,
	double passed;           ///< which would still pass through by this much [m]; 0: its impulse was not found
	double travel;           ///< then: the longest way of a node in that attempt [m]
	JnContactObserver* observer;
	void* observer_user;
	JnContactTally tally, total; ///< of the attempt; of accepted steps, works summed up
} JnContactPass;

/// Let `observer` see the problems of a contact pass from now on; NULL: nobody.
void jn_contact_observe(JnPass* pass, JnContactObserver* observer, void* user);

/// Skins, obstacles, friction and detector, from the definitions of bodies. JN_BAD_INPUT after a message.
JnStatus jn_contact_surfaces_create(JnContactPass* pass);

/// Where the entries of a body begin in a vector of 3 * nodes, and how many they are.
static inline size_t jn_contact_first_entry(const JnContactPass* pass, int body) {
	return 3 * (size_t)pass->model->bodies[body].first_node;
}

static inline size_t jn_contact_entry_count(const JnContactPass* pass, int body) {
	return 3 * (size_t)pass->model->bodies[body].mesh.node_count;
}

static inline size_t jn_contact_entries(const JnContactPass* pass) {
	return 3 * (size_t)pass->model->node_count;
}

JnStatus jn_contact_create(const void* options, JnModel* model, JnPass** out);
void jn_contact_destroy(JnPass* pass);

/// Find the contacts on the way to the predicted end, make rows of them, and begin with the impulses of the last step.
JnStatus jn_contact_find(JnContactPass* pass, const JnStep* step, int64_t* pairs);

/// Look for what is met on the way to `x` and is not among the contacts found: *missed of them join pass->found. *depth:
/// of the deepest, which pass->worst becomes [m].
JnStatus jn_contact_look_again(JnContactPass* pass, const JnStep* step, const double* x, int* missed, double* depth);

/// Rows of all contacts found, beginning with the impulses of those that were there.
JnStatus jn_contact_extend(JnContactPass* pass, const JnStep* step);

/// Velocities into pass->v, positions into pass->corrected, impulses into pass->now.lambda. The step's end is left alone.
JnStatus jn_contact_correct(JnContactPass* pass, const JnStep* step);

/// Take them as the end. Whether that changes anything.
bool jn_contact_move(JnContactPass* pass, JnStep* step);

/// Kinetic, elastic and gravitational energy of a state [J].
double jn_contact_energy(const JnContactPass* pass, const JnState* state);

/// Work of nodal forces over the displacements of a step [J], on the entries that are held or on those that are not.
double jn_contact_work(const JnContactPass* pass, const double* force, const JnStep* step, bool on_held);

/// Fill the works, the overlap and the loss of pass->tally; `before`: energy without contact's work in the step [J].
void jn_contact_tally(JnContactPass* pass, const JnStep* step, double before);
/// Counters of the step, works summed up.
void jn_contact_tally_add(const JnContactTally* step, JnContactTally* total);

/// Fill pass->gap: the least gap of each node that carries a vertex, at the end; the margin where nothing is near.
void jn_contact_find_gaps(JnContactPass* pass, const JnStep* step);

enum { JN_CONTACT_COLUMNS = 11, JN_CONTACT_FIELDS = 2 };
extern const JnPassColumn jn_contact_columns[JN_CONTACT_COLUMNS];
extern const JnPassField jn_contact_fields[JN_CONTACT_FIELDS];
void jn_contact_measure(const JnPass* pass, double* values);
const double* jn_contact_field(const JnPass* pass, int index);

/// -1, 0 or 1: order of two contacts, as far as it is the same from step to step: by vertex and what it meets.
int jn_contact_order(const JnContact* a, const JnContact* b);

/// The geometry of rows, for relative velocities and impulses.
JnContactProblem jn_contact_geometry(const JnContactRows* rows);

/// Rows of contacts, between the start and the predicted end of a step.
JnStatus jn_contact_rows_fill(JnContactPass* pass, const JnContactSet* found, const JnStep* step, JnContactRows* rows);

/// Begin with the impulses of the same contacts in `old`.
void jn_contact_rows_warm(JnContactRows* rows, const JnContactRows* old);

/// Write or read what later steps begin with: contacts, frames and impulses.
void jn_contact_rows_archive(JnContactRows* rows, JnArchive* archive);

void jn_contact_rows_release(JnContactRows* rows);

/// Room for `count` rows with `entries` nodes in all; what was there is lost when it must grow.
JnStatus jn_contact_rows_reserve(JnContactRows* rows, int count, int entries);

/// Give every row and body the number of its island; pass->moves follows. Returns how many islands there are.
int jn_contact_islands_find(JnContactPass* pass, const JnStep* step);

/// Solve the contact problem of an island: velocities into pass->v, impulses into pass->now.lambda.
JnStatus jn_contact_island_solve(JnContactPass* pass, int island);

/// The matrix of the bodies that pass->is_in names, by its verbs.
JnContactMatrix jn_contact_matrix(JnContactPass* pass);

#endif
