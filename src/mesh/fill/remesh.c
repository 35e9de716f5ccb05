// Sweeps of local edits. None may turn a triangle over or leave a bad one where there were better: that is asked of all
// triangles around the nodes that move.
#include "mesh/fill/remesh.h"

#include <math.h>

#include "math/vec3.h"

enum { SWEEPS = 10 };
static const double LONGEST = 4.0 / 3.0, SHORTEST = 4.0 / 5.0; ///< of an edge, in units of size
static const double LEAST_COSINE = 0.3;                        ///< between a triangle's normals before and after
static const double LEAST_MOVE = 0.02;                         ///< of a node, in units of size
static const double LEAST_QUALITY = 0.3; ///< that collapsing an edge may leave, after the first sweeps
static const double GOOD = 0.4;          ///< quality that an edit may leave even where it was better

typedef struct Remesh {
	JnHalfEdges* mesh;
	double size; ///< [m]
	const JnGuide* guide;
} Remesh;

double jn_triangle_quality(const double a[3], const double b[3], const double c[3]) {
	double normal[3];
	vec3_triangle(a, b, c, normal);
	const double ab = vec3_distance(a, b), bc = vec3_distance(b, c), ca = vec3_distance(c, a);
	const double edges = ab * ab + bc * bc + ca * ca;
	return edges > 0 ? 2 * sqrt(3) * vec3_length(normal) / edges : 0;
}

static double* place(const JnHalfEdges* mesh, int node) {
	return mesh->nodes + 3 * (ptrdiff_t)node;
}

/// Length that an edge near p should have [m].
static double size_at(const Remesh* re, const double p[3]) {
	return re->guide->size != NULL ? fmin(re->size, re->guide->size(re->guide->shape, p)) : re->size;
}

/// Length of an edge in units of what it should be.
static double relative_length(const Remesh* re, int h) {
	const double *a = place(re->mesh, re->mesh->from[h]), *b = place(re->mesh, jn_to(re->mesh, h));
	const double middle[3] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
	return vec3_distance(a, b) / size_at(re, middle);
}

/// Does a triangle a b c face another way when a moves to p? One without area faces nowhere.
static bool is_turned(const Remesh* re, const double* a, const double* b, const double* c, const double p[3]) {
	double before[3], after[3];
	vec3_triangle(a, b, c, before);
	vec3_triangle(p, b, c, after);
	const double length = vec3_length(before), no_area = 1e-5 * re->size * re->size;
	return length > no_area && vec3_dot(before, after) < LEAST_COSINE * length * vec3_length(after);
}

/// The worst quality of the triangles around a node if it were at p, without those of edge `gone` (-1: none);
/// -1 when one were turned over.
static double worst_around(const Remesh* re, int node, const double p[3], int gone) {
	const JnHalfEdges* mesh = re->mesh;
	const int first = gone >= 0 ? gone / 3 : -1, second = gone >= 0 ? mesh->twin[gone] / 3 : -1;
	double worst = 1;
	int h = mesh->leaving[node];
	do {
		if (h / 3 != first && h / 3 != second) {
			const double *b = place(mesh, jn_to(mesh, h)), *c = place(mesh, mesh->from[jn_before(h)]);
			if (is_turned(re, place(mesh, node), b, c, p)) return -1;
			worst = fmin(worst, jn_triangle_quality(p, b, c));
		}
		h = jn_turn(mesh, h);
	} while (h != mesh->leaving[node]);
	return worst;
}

static double longest_around(const JnHalfEdges* mesh, int node, const double p[3]) {
	double longest = 0;
	int h = mesh->leaving[node];
	do {
		longest = fmax(longest, vec3_distance(p, place(mesh, jn_to(mesh, h))));
		h = jn_turn(mesh, h);
	} while (h != mesh->leaving[node]);
	return longest;
}

/// Split an edge; the new node goes onto the surface, unless it is in a crease or that turned a triangle over.
static JnStatus split(Remesh* re, int h) {
	JnHalfEdges* mesh = re->mesh;
	const bool is_crease = mesh->crease[h];
	JN_TRY(jn_half_edges_split(mesh, h));
	const int node = mesh->node_count - 1;
	double p[3] = {place(mesh, node)[0], place(mesh, node)[1], place(mesh, node)[2]};
	if (!is_crease) re->guide->project(re->guide->shape, p);
	if (worst_around(re, node, p, -1) < 0) return JN_OK;
	for (int a = 0; a < 3; a++) place(mesh, node)[a] = p[a];
	return JN_OK;
}

/// The longest ones first, in classes: splitting a shorter side of a triangle first makes it worse and new edges long.
static JnStatus split_long_edges(Remesh* re) {
	JnHalfEdges* mesh = re->mesh;
	double longest = 0;
	for (int h = 0; h < mesh->count; h++)
		if (mesh->from[h] >= 0) longest = fmax(longest, relative_length(re, h));
	while (longest > LONGEST) {
		longest = fmax(longest / 1.25, LONGEST);
		for (int h = 0; h < mesh->count; h++)
			if (mesh->from[h] >= 0 && relative_length(re, h) > longest) JN_TRY(split(re, h));
	}
	return JN_OK;
}

/// May the start of an edge leave its place: it is smooth, or on a crease that the edge follows?
static bool may_leave(const JnHalfEdges* mesh, int h) {
	const int count = jn_crease_count(mesh, mesh->from[h]), g = mesh->twin[h];
	if (count == 0) return true;
	return count == 2 && mesh->crease[h] && !mesh->crease[jn_before(h)] && !mesh->crease[jn_next(g)];
}

/// Collapse an edge, unless that harms the surface.
static bool collapse(Remesh* re, int h, double least_quality) {
	JnHalfEdges* mesh = re->mesh;
	if (!may_leave(mesh, h)) h = mesh->twin[h];
	if (!may_leave(mesh, h) || !jn_half_edges_can_collapse(mesh, h)) return false;
	const int a = mesh->from[h], b = jn_to(mesh, h);
	const bool is_free = jn_crease_count(mesh, b) == 0;
	double p[3] = {place(mesh, b)[0], place(mesh, b)[1], place(mesh, b)[2]};
	for (int i = 0; i < 3 && is_free; i++) p[i] = 0.5 * (place(mesh, a)[i] + place(mesh, b)[i]);
	if (fmax(longest_around(mesh, a, p), longest_around(mesh, b, p)) > LONGEST * size_at(re, p)) return false;
	if (is_free) re->guide->project(re->guide->shape, p);
	if (fmin(worst_around(re, a, p, h), worst_around(re, b, p, h)) < least_quality) return false;
	for (int i = 0; i < 3; i++) place(mesh, b)[i] = p[i];
	jn_half_edges_collapse(mesh, h);
	return true;
}

static void collapse_short_edges(Remesh* re, double shortest, double least_quality) {
	JnHalfEdges* mesh = re->mesh;
	for (int h = 0; h < mesh->count; h++)
		if (mesh->from[h] >= 0 && relative_length(re, h) < shortest) collapse(re, h, least_quality);
}

static double worse_of(const double* a, const double* b, const double* c, const double* d, const double* e,
					   const double* f) {
	return fmin(jn_triangle_quality(a, b, c), jn_triangle_quality(d, e, f));
}

/// Flip where that makes the worse of the two triangles better.
static int flip_edges(Remesh* re) {
	JnHalfEdges* mesh = re->mesh;
	int flips = 0;
	for (int h = 0; h < mesh->count; h++) {
		if (mesh->from[h] < 0 || mesh->crease[h] || mesh->twin[h] < h) continue;
		const double *a = place(mesh, mesh->from[h]), *b = place(mesh, jn_to(mesh, h));
		const double *c = place(mesh, mesh->from[jn_before(h)]), *d = place(mesh, mesh->from[jn_before(mesh->twin[h])]);
		if (worse_of(d, c, a, c, d, b) <= 1.001 * worse_of(a, b, c, b, a, d)) continue;
		// a b c and b a d become d c a and c d b: both must face as the two did
		const bool is_bent = is_turned(re, b, c, a, d) || is_turned(re, a, b, c, d) || is_turned(re, a, d, b, c) ||
							 is_turned(re, b, a, d, c);
		flips += !is_bent && jn_half_edges_flip(mesh, h);
	}
	return flips;
}

/// The centre of the triangles around a smooth node, weighted by area, without the part along the normal.
static void centre_along_surface(const JnHalfEdges* mesh, int node, double p[3]) {
	const double* x = place(mesh, node);
	double sum[3] = {0}, normal[3] = {0}, area = 0;
	int h = mesh->leaving[node];
	do {
		const double *b = place(mesh, jn_to(mesh, h)), *c = place(mesh, mesh->from[jn_before(h)]);
		double n[3];
		vec3_triangle(x, b, c, n);
		const double weight = vec3_length(n);
		for (int i = 0; i < 3; i++) sum[i] += weight * ((x[i] + b[i] + c[i]) / 3 - x[i]);
		for (int i = 0; i < 3; i++) normal[i] += n[i];
		area += weight;
		h = jn_turn(mesh, h);
	} while (h != mesh->leaving[node]);
	vec3_normalize(normal);
	const double along = vec3_dot(sum, normal);
	for (int i = 0; i < 3; i++) p[i] = x[i] + (area > 0 ? (sum[i] - along * normal[i]) / area : 0);
}

static void move_nodes(Remesh* re) {
	JnHalfEdges* mesh = re->mesh;
	for (int node = 0; node < mesh->node_count; node++) {
		if (mesh->leaving[node] < 0 || jn_crease_count(mesh, node) > 0) continue;
		double p[3];
		centre_along_surface(mesh, node, p);
		if (vec3_distance(p, place(mesh, node)) < LEAST_MOVE * re->size) continue;
		re->guide->project(re->guide->shape, p);
		const double before = worst_around(re, node, place(mesh, node), -1), after = worst_around(re, node, p, -1);
		if (after < fmin(before, GOOD)) continue;
		for (int i = 0; i < 3; i++) place(mesh, node)[i] = p[i];
	}
}

JnStatus jn_remesh(JnHalfEdges* mesh, double size, const JnGuide* guide) {
	Remesh re = {.mesh = mesh, .size = size, .guide = guide};
	for (int sweep = 0; sweep < SWEEPS; sweep++) {
		JN_TRY(split_long_edges(&re));
		collapse_short_edges(&re, SHORTEST, sweep < 3 ? 0 : LEAST_QUALITY);
		flip_edges(&re);
		move_nodes(&re);
	}
	collapse_short_edges(&re, SHORTEST / 2, LEAST_QUALITY);
	for (int round = 0; round < SWEEPS && flip_edges(&re) > 0; round++) move_nodes(&re);
	return JN_OK;
}
