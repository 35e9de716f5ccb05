// The rotation is found by the iteration of Mueller, Bender, Chentanez and Macklin (A robust method to extract the
// rotational part of deformations, 2016), which turns R by
//   w = (sum of r_k x a_k) / |sum of r_k . a_k|,    r_k and a_k the columns of R and A,
// from the last R on. It needs no inverse, so that A may have any rank: about a line or a plane of neighbours R turns no
// further than it must, and without neighbours it stays.
#include "solve/node_rotation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/aligned.h"
#include "base/log.h"
#include "base/parallel.h"

enum { GRAIN = 2048, MOST = 20 }; // nodes a thread should have; iterations
static const float still = 1e-3f; // a turn that is not worth another iteration [rad]
static const float longest = 1;   // of w, as longer turns would go to and fro about a plane
static const float least = 1e-6f; // of the denominator, relative to |A|
static const float small = 0.05f; // moves below this share of the spacing turn nothing by much

typedef float Node __attribute__((vector_size(4 * sizeof(float)), may_alias));

JnStatus jn_node_rotation_create(JnNodeRotation* rotation, const JnPattern* pattern, const bool* held, int threads) {
	const size_t length = jn_single_length(pattern->nodes), blocks = JN_SINGLE_INVERSE * (size_t)pattern->nodes;
	*rotation = (JnNodeRotation){.pattern = pattern, .held = held, .threads = threads};
	rotation->from = jn_single_vector(length);
	rotation->now = jn_single_vector(length);
	rotation->quaternion = jn_single_vector(length);
	rotation->turn = jn_single_vector(blocks);
	rotation->back = jn_single_vector(blocks);
	if (rotation->from != NULL && rotation->now != NULL && rotation->quaternion != NULL && rotation->turn != NULL &&
		rotation->back != NULL)
		return JN_OK;
	return jn_error(JN_OUT_OF_MEMORY, "out of memory: rotations of %d nodes", pattern->nodes);
}

void jn_node_rotation_destroy(JnNodeRotation* rotation) {
	float* const vectors[] = {rotation->from, rotation->now, rotation->quaternion, rotation->turn, rotation->back};
	for (int i = 0; i < 5; ++i) jn_aligned_free(vectors[i]);
	*rotation = (JnNodeRotation){0};
}

// Relative to the first node, so that single precision resolves the distances of neighbours far from the origin.
static void place(int nodes, const double* x, float* out) {
	for (int node = 0; node < nodes; ++node)
		for (int axis = 0; axis < 3; ++axis) out[4 * node + axis] = (float)(x[3 * node + axis] - x[axis]);
}

static float length_of(Node a) {
	return sqrtf(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static float mean_spacing(const JnPattern* pattern, const float* x) {
	double total = 0;
	const Node* at = (const Node*)x;
	for (int node = 0; node < pattern->nodes; ++node)
		for (int k = pattern->column_start[node] + 1; k < pattern->column_start[node + 1]; ++k)
			total += (double)length_of(at[pattern->row[k]] - at[node]);
	return (float)(total / fmax(1, pattern->blocks - pattern->nodes));
}

static void put_identity(JnNodeRotation* rotation, int node) {
	for (int k = 0; k < 4; ++k) rotation->quaternion[4 * node + k] = k == 3;
	for (int k = 0; k < JN_SINGLE_INVERSE; ++k)
		rotation->turn[JN_SINGLE_INVERSE * node + k] = rotation->back[JN_SINGLE_INVERSE * node + k] = k % 5 == 0;
}

void jn_node_rotation_begin(JnNodeRotation* rotation, const double* x) {
	place(rotation->pattern->nodes, x, rotation->from);
	memcpy(rotation->now, rotation->from, 4 * (size_t)rotation->pattern->nodes * sizeof *rotation->now);
	for (int node = 0; node < rotation->pattern->nodes; ++node) put_identity(rotation, node);
	rotation->spacing = mean_spacing(rotation->pattern, rotation->from);
	rotation->is_turned = false;
}

// Columns of A, each with 0 behind it; scaled to norm 1 where there is one.
static void surroundings(const JnNodeRotation* rotation, int node, Node A[3]) {
	const JnPattern* pattern = rotation->pattern;
	const Node *X = (const Node*)rotation->from, *x = (const Node*)rotation->now;
	Node sum[3] = {{0}, {0}, {0}};
	for (int k = pattern->full_start[node]; k < pattern->full_start[node + 1]; ++k) {
		const int other = pattern->full_column[k];
		const Node before = X[other] - X[node], after = x[other] - x[node];
		for (int c = 0; c < 3; ++c) sum[c] += after * before[c];
	}
	const Node squares = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
	const float norm = sqrtf(squares[0] + squares[1] + squares[2]), scale = norm > 0 ? 1 / norm : 0;
	for (int c = 0; c < 3; ++c) A[c] = sum[c] * scale;
}

static Node cross(Node a, Node b) {
	return (Node){a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0};
}

static float dot(Node a, Node b) {
	const Node product = a * b;
	return product[0] + product[1] + product[2];
}

static void columns_of(Node q, Node R[3]) {
	const float x = q[0], y = q[1], z = q[2], w = q[3];
	R[0] = (Node){1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0};
	R[1] = (Node){2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0};
	R[2] = (Node){2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0};
}

// (w / 2, 1) q, normalised: q turned by about w.
static Node turned(Node q, Node w) {
	const Node half = w * 0.5f, along = cross(half, q);
	Node out = q + half * q[3] + along;
	out[3] = q[3] - dot(half, q);
	const Node squares = out * out;
	return out * (1 / sqrtf(squares[0] + squares[1] + squares[2] + squares[3]));
}

static Node nearest_rotation(const Node A[3], Node q, Node R[3]) {
	for (int i = 0; i < MOST; ++i) {
		columns_of(q, R);
		const float along = fabsf(dot(R[0], A[0]) + dot(R[1], A[1]) + dot(R[2], A[2]));
		const Node w = (cross(R[0], A[0]) + cross(R[1], A[1]) + cross(R[2], A[2])) * (1 / (along + least));
		const float angle = length_of(w);
		if (!(angle > 0)) break;
		q = turned(q, w * fminf(1, longest / angle));
		if (angle <= still) break;
	}
	columns_of(q, R);
	return q;
}

static bool is_finite(Node q) {
	return isfinite(q[0] + q[1] + q[2] + q[3]);
}

static void follow_node(JnNodeRotation* rotation, int node) {
	const bool* held = rotation->held + 3 * (size_t)node;
	Node A[3], R[3], *quaternion = (Node*)rotation->quaternion + node;
	if (held[0] || held[1] || held[2]) return;
	surroundings(rotation, node, A);
	const Node q = nearest_rotation(A, *quaternion, R);
	if (!is_finite(q)) {
		put_identity(rotation, node);
		return;
	}
	*quaternion = q;
	float *turn = rotation->turn + JN_SINGLE_INVERSE * (size_t)node,
		  *back = rotation->back + JN_SINGLE_INVERSE * (size_t)node;
	for (int column = 0; column < 3; ++column)
		for (int row = 0; row < 3; ++row) turn[4 * column + row] = back[4 * row + column] = R[column][row];
}

static bool has_moved(const JnNodeRotation* rotation, const double* x) {
	const float limit = small * rotation->spacing;
	for (int node = 0; node < rotation->pattern->nodes; ++node)
		for (int axis = 0; axis < 3; ++axis) {
			const float at = (float)(x[3 * node + axis] - x[axis]);
			if (!(fabsf(at - rotation->now[4 * node + axis]) <= limit)) return true;
		}
	return false;
}

void jn_node_rotation_follow(JnNodeRotation* rotation, const double* x) {
	const int nodes = rotation->pattern->nodes, team = jn_threads_for((size_t)nodes, GRAIN, rotation->threads);
	if (!has_moved(rotation, x)) return;
	place(nodes, x, rotation->now);
#pragma omp parallel for schedule(static) num_threads(team) if (team > 1)
	for (int node = 0; node < nodes; ++node) follow_node(rotation, node);
	rotation->is_turned = true;
}
