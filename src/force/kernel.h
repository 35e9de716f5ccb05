/// @file kernel.h
/// An element kernel: one (element, law) pair over batches of W elements. No indirect call inside its loops.
///
///   batch 0: elements 0 .. W-1    batch 1: elements W .. 2W-1   ...   the last one padded by repeating its last element
///   every per-element number stands as [batch][...][lane], so that a lane is one element and a row is one vector
///
/// W = 8 with AVX-512, 4 with AVX2 and FMA, 2 otherwise: the same sources compiled three times, chosen at run time.
#ifndef JN_FORCE_KERNEL_H
#define JN_FORCE_KERNEL_H

#include "base/arena.h"
#include "jounce/extend.h"
#include "mesh/mesh.h"

enum { JN_LAW_CONSTANTS = 8 };

/// Keys of `material:` that all laws share.
typedef struct JnMaterialDef {
	double density; ///< [kg/m^3]
	double young;   ///< E [Pa]
	double poisson; ///< nu
} JnMaterialDef;

typedef struct JnGroup JnGroup;
typedef struct JnLaw JnLaw;

/// What a law makes of a mesh.
typedef struct JnGroups {
	int count;
	JnGroup* list;
	double density; ///< [kg/m^3]; of a surface [kg/m^2]
} JnGroups;

/// What relaxation may move.
typedef enum JnRelaxed {
	JN_RELAXED_SPRINGS = 1, ///< lengths of springs
	JN_RELAXED_AXIS = 2,    ///< of a thread: distances of neighbouring frames along its axis
	JN_RELAXED_VOLUMES = 4, ///< of tetrahedra
} JnRelaxed;

/// A constitutive law as scene files name it. What a solid's computes stands in material/<name>.h, compiled into the
/// kernels.
struct JnLaw {
	JnRow row;
	/// The element groups of a body, whose nodes get `first_node` added; `options` as row.keys fill them, `what` is the
	/// key path of the body for messages. JN_BAD_INPUT when the law does not run on the mesh's shape.
	JnStatus (*build)(const JnLaw*, const void* options, const JnMesh* mesh, int first_node, const char* what,
					  JnArena* arena, JnGroups* out);
	void (*prepare)(const JnMaterialDef* def, double constants[JN_LAW_CONSTANTS]); ///< of solids: Lame constants etc.
	bool is_linear_in_step; ///< force linear in x between two freezes: Newton needs one iteration
	/// Groups of what relaxation may move (relax.h), up to JN_RELAX_COUNT; `kinds` are bits of JnRelaxed. NULL: nothing.
	JnStatus (*relaxed)(unsigned kinds, const JnMesh* mesh, int first_node, JnArena* arena, JnGroups* out);
};

extern const JnRowList jn_law_list; ///< rows are &JnLaw.row

/// JnLaw.build of solids: one group, of the kernel of (shape, law).
JnStatus jn_solid_build(const JnLaw* law, const void* options, const JnMesh* mesh, int first_node, const char* what,
						JnArena* arena, JnGroups* out);

/// How relax() moves nodes.
typedef struct JnRelaxation {
	const double* inverse_mass; ///< 3 * nodes of the model [1/kg]; 0: this coordinate is held
	double compliance;          ///< alpha / dt^2, with alpha = 1/k of a measure whose energy is k/2 C^2; 0: rigid
	double factor;              ///< of every correction, in (0, 2); 1: as much as restores C = 0
} JnRelaxation;

typedef struct JnKernel {
	const JnLaw* law; ///< of a solid; NULL: several laws build groups of this kernel
	JnShape shape;    ///< of a solid
	const char* name; ///< of others, such as "spring"
	int width;        ///< W: elements in a batch
	int nodes;        ///< nodes of an element
	int points;       ///< quadrature points of an element
	int rest_reals;   ///< doubles a point in group->rest
	int frozen_reals; ///< doubles a point that freeze() keeps; 0: none

	/// out[batch - first][lane] = elastic energy of each element [J], first <= batch < last.
	void (*energy)(const JnGroup*, int first, int last, const double* x, double* out);
	/// out[batch - first][3 * nodes][lane] = force on each node of the element [N], -dE/dx.
	void (*force)(const JnGroup*, int first, int last, const double* x, double* out);
	/// out[batch - first][pair][9][lane] = 3x3 blocks of K = -df/dx [N/m], row-major, for the local node pairs
	/// (0,0) (1,0) (1,1) (2,0) ...: pair = i (i + 1) / 2 + j, j <= i. `definite`: eigenvalues of dP/dF clamped to >= 0.
	void (*tangent)(const JnGroup*, int first, int last, const double* x, bool definite, double* out);
	/// Fix what stays constant over a step (rotations) from x, into group->frozen. NULL: nothing to fix.
	void (*freeze)(JnGroup*, int first, int last, const double* x);
	/// out[batch - first][3 * nodes][lane] = K p of each element [N], K as tangent() makes it at x. NULL: this kernel's
	/// matrices must be assembled.
	void (*product)(const JnGroup*, int first, int last, const double* x, bool definite, const double* p, double* out);
	/// product() in single precision, in two steps. Batches go in pairs, 2 W lanes: 0 and 1, 2 and 3, ..., the last one
	/// with itself where it is alone; `first` is even. store: what K p needs of x, stored_reals[definite] floats a point,
	/// into stored[pair][points][stored_reals][2 W], `stored` that of the whole group. NULL: double precision alone.
	void (*store)(const JnGroup*, int first, int last, const double* x, bool definite, float* stored);
	/// out[pair - first / 2][3 * nodes][2 W] = K p of each element [N], p with 4 floats a node; `stored` is that of `first`.
	void (*product_single)(const JnGroup*, int first, int last, bool definite, const float* stored, const float* p,
						   float* out);
	int stored_reals[2];
	/// out[batch - first][nodes][6][lane] = the diagonal blocks of tangent(), each its lower triangle by rows. NULL: take
	/// those of tangent().
	void (*diagonal)(const JnGroup*, int first, int last, const double* x, bool definite, double* out);
	/// Break the elements that x strains too much, or that have a node of `doomed` (one a node of the model, or NULL): they
	/// have no force from then on. Writes their numbers to `broken`, adds the energy that they held to *released [J],
	/// returns how many. NULL: nothing breaks.
	int (*damage)(JnGroup*, int first, int last, const double* x, const bool* doomed, int* broken, double* released);
	/// Move x onto the rest measure, element by element: no two of a batch may share a node. lambda[batch][lane] is what the
	/// sweeps of a step have summed up. NULL: elements without such a measure.
	void (*relax)(const JnGroup*, int first, int last, const JnRelaxation* how, double* x, double* lambda);
	/// out[batch - first][lane] = C of each element over its size at rest, such as (l - L) / L; 0 in padding. With relax().
	void (*strain)(const JnGroup*, int first, int last, const double* x, double* out);
} JnKernel;

/// Some of a body's elements, of one kernel.
struct JnGroup {
	const JnKernel* kernel;
	int count;       ///< elements
	int batches;     ///< ceil(count / W)
	int* nodes;      ///< [batches][nodes][W]: node numbers; 3 * node is the offset in x
	int rest_points; ///< of solids: 1 when one point's rest data serve all of an element (parallelepipeds), else all
	/// [batches][points][rest_reals][W], so that padding adds nothing. Solids: L by rows, where L L^T = J0^-1 J0^-T, J0 =
	/// dX/dxi the rest Jacobian, and the weight [m^3], which is 0 in padding; rest_points of them.
	double* rest;
	float* rest_single; ///< of solids: sqrt(weight) L, [pairs of batches][rest_points][6][2 W]
	double* frozen;     ///< [batches][points][frozen_reals][W], or NULL
	double constants[JN_LAW_CONSTANTS];
	double damping; ///< stiffness-proportional damping of this group, beside that of the body [s]
};

/// Node `i` of an element.
static inline int jn_group_node(const JnGroup* group, int element, int i) {
	const int width = group->kernel->width;
	const ptrdiff_t row = (ptrdiff_t)(element / width) * group->kernel->nodes + i;
	return group->nodes[row * width + element % width];
}

/// The kernel of (shape, law) for the widest unit that this processor has, or for `width` lanes when that is not 0
/// (NULL if the processor lacks them).
const JnKernel* jn_kernel_find(JnShape shape, const JnLaw* law, int width);

/// Lanes that jn_kernel_find chooses by itself: 8, 4 or 2.
int jn_kernel_best_width(void);

/// Build the group of a mesh's cells; `nodes_offset` is added to each node number. Fails with JN_BAD_INPUT naming the
/// first cell whose rest Jacobian is not positive; `what` is the key path of the body for messages.
JnStatus jn_group_create(const JnKernel* kernel, const JnMesh* mesh, int nodes_offset, const JnMaterialDef* material,
						 const char* what, JnArena* arena, JnGroup* group);

/// Consistent element mass: out[i * nodes + j] = integral of density N_i N_j over `cell` [kg], exact for straight sides.
/// Of a triangle with the density [kg/m^2], of a point its volume times density.
void jn_group_cell_mass(const JnMesh* mesh, int cell, double density, double* out);

#endif
