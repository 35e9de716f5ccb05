/// @file qp_case.h
/// Contact problems for tests: random dense matrices, boxes of hexahedra (C = M + dt^2 K of a model), and contacts between
/// them that are added one by one.
#ifndef JN_TEST_SOLVE_QP_CASE_H
#define JN_TEST_SOLVE_QP_CASE_H

#include "model/stiffness.h"
#include "solve/qp.h"
#include "support/model_case.h"

enum { QP_CASE_LIMIT = 6000, QP_NODES_LIMIT = 5 * QP_CASE_LIMIT };

typedef struct QpCase {
	JnArena arena;
	JnPattern pattern, body_pattern; ///< of all, and of one of several bodies
	double *blocks, *vp, *v, *lambda;
	double* place; ///< rest positions of boxes [m]; NULL of dense cases
	bool* held;
	JnSolver* solver;  ///< of all bodies together
	JnSolver** halves; ///< of each body alone
	int *first_node, *start, *node;
	double *weight, *friction;
	double (*frame)[9], (*bound)[3];
	JnContactProblem problem;
	JnQpReport report;
} QpCase;

static inline void qp_apply(void* user, const double* x, double* out) {
	const QpCase* c = user;
	memset(out, 0, 3 * (size_t)c->pattern.nodes * sizeof *out);
	jn_blocks_apply(&c->pattern, c->blocks, 1, x, out, 1);
}

static inline JnStatus qp_solve_one(void* user, const double* rhs, double* out) {
	const QpCase* c = user;
	return jn_solver_direct.solve(c->solver, 0, rhs, out);
}

static inline JnStatus qp_solve_many(void* user, int count, const double* rhs, double* out) {
	const QpCase* c = user;
	return jn_solver_direct.solve_many(c->solver, 0, count, rhs, out);
}

static inline JnStatus qp_half(void* user, int body, const JnColumns* columns, JnHalf* out) {
	const QpCase* c = user;
	return jn_solver_direct.half(c->halves[body], 0, columns, out);
}

static inline void qp_diagonal(void* user, double* out) {
	const QpCase* c = user;
	for (int node = 0; node < c->pattern.nodes; ++node)
		for (int axis = 0; axis < 3; ++axis)
			out[3 * node + axis] = c->blocks[9 * (size_t)c->pattern.column_start[node] + 4 * (size_t)axis];
}

#define QP_TAKE(c, field, count) ((c)->field = jn_arena_take(&(c)->arena, (size_t)(count), sizeof *(c)->field))

/// Factor C, of all bodies and of each.
static inline void qp_case_factor(QpCase* c) {
	assert_int_equal(jn_solver_direct.factor(c->solver, 0, c->blocks), JN_OK);
	for (int b = 0; b < c->problem.body_count; ++b) {
		const double* blocks = c->blocks + 9 * (size_t)c->pattern.column_start[c->first_node[b]];
		assert_int_equal(jn_solver_direct.factor(c->halves[b], 0, blocks), JN_OK);
	}
}

/// After pattern, blocks and held are there: the rest of a problem without contacts, and the factor of C.
static inline void qp_case_finish(QpCase* c, int bodies) {
	const int nodes = c->pattern.nodes;
	QP_TAKE(c, vp, 3 * nodes), QP_TAKE(c, v, 3 * nodes), QP_TAKE(c, lambda, 3 * QP_CASE_LIMIT);
	QP_TAKE(c, first_node, bodies + 1), QP_TAKE(c, start, QP_CASE_LIMIT + 1), QP_TAKE(c, node, QP_NODES_LIMIT);
	QP_TAKE(c, weight, QP_NODES_LIMIT), QP_TAKE(c, bound, QP_CASE_LIMIT), QP_TAKE(c, friction, QP_CASE_LIMIT);
	QP_TAKE(c, frame, QP_CASE_LIMIT);
	for (int b = 0; b <= bodies; ++b) c->first_node[b] = nodes / bodies * b;
	c->problem = (JnContactProblem){
		.nodes = nodes,
		.matrix = {c, qp_apply, qp_solve_one, qp_solve_many, qp_diagonal, &c->pattern, c->blocks, qp_half},
		.held = c->held,
		.vp = c->vp,
		.body_count = bodies,
		.first_node = c->first_node,
		.start = c->start,
		.node = c->node,
		.weight = c->weight,
		.frame = (const double(*)[9])c->frame,
		.bound = (const double(*)[3])c->bound,
		.friction = c->friction,
	};
	const JnDirectDef options = {.precision = 1};
	assert_int_equal(jn_solver_direct.create(&options, &c->pattern, c->held, 1, &c->solver), JN_OK);
	QP_TAKE(c, halves, bodies);
	for (int b = 0; b < bodies; ++b) {
		const JnPattern* one = bodies == 1 ? &c->pattern : &c->body_pattern;
		const bool* held = c->held + 3 * c->first_node[b];
		assert_int_equal(jn_solver_direct.create(&options, one, held, 1, &c->halves[b]), JN_OK);
	}
	qp_case_factor(c);
}

/// C = B B' / n + I over `nodes` nodes, B random in [-1, 1], one body.
static inline void qp_case_dense(QpCase* c, int nodes, uint64_t seed) {
	*c = (QpCase){0};
	int* all = jn_arena_take(&c->arena, (size_t)nodes, sizeof *all);
	for (int k = 0; k < nodes; ++k) all[k] = k;
	const JnCellList cell = {.count = 1, .nodes = nodes, .cells = all};
	assert_int_equal(jn_pattern_create(nodes, 1, &cell, &c->arena, &c->pattern), JN_OK);
	const int n = 3 * nodes;
	double* b = jn_arena_take(&c->arena, (size_t)n * (size_t)n, sizeof *b);
	fill_random(&seed, 1, n * n, b);
	QP_TAKE(c, blocks, 9 * c->pattern.blocks), QP_TAKE(c, held, n);
	for (int j = 0; j < nodes; ++j)
		for (int k = c->pattern.column_start[j]; k < c->pattern.column_start[j + 1]; ++k)
			for (int e = 0; e < 9; ++e) {
				const int row = 3 * c->pattern.row[k] + e / 3, column = 3 * j + e % 3;
				double sum = row == column;
				for (int i = 0; i < n; ++i) sum += b[row * n + i] * b[column * n + i] / n;
				c->blocks[9 * (size_t)k + (size_t)e] = sum;
			}
	qp_case_finish(c, 1);
}

/// The first `nodes` nodes of a pattern whose bodies are alike; shares its arrays.
static inline JnPattern qp_first_body(const JnPattern* all, int nodes) {
	JnPattern one = *all;
	one.nodes = nodes;
	one.blocks = all->column_start[nodes];
	return one;
}

/// The pattern of `copies` bodies like the one of `from`.
static inline void qp_repeat_pattern(QpCase* c, const JnPattern* from, int copies) {
	const int nodes = from->nodes, blocks = from->blocks, full = from->full_start[nodes];
	JnPattern* to = &c->pattern;
	*to = (JnPattern){.nodes = copies * nodes, .blocks = copies * blocks};
	QP_TAKE(c, pattern.column_start, to->nodes + 1), QP_TAKE(c, pattern.row, to->blocks);
	QP_TAKE(c, pattern.full_start, to->nodes + 1), QP_TAKE(c, pattern.full_column, copies * full);
	QP_TAKE(c, pattern.full_block, copies * full);
	for (int b = 0; b < copies; ++b) {
		for (int k = 0; k <= nodes; ++k) to->column_start[b * nodes + k] = b * blocks + from->column_start[k];
		for (int k = 0; k <= nodes; ++k) to->full_start[b * nodes + k] = b * full + from->full_start[k];
		for (int k = 0; k < blocks; ++k) to->row[b * blocks + k] = b * nodes + from->row[k];
		for (int k = 0; k < full; ++k) to->full_column[b * full + k] = b * nodes + from->full_column[k];
		for (int k = 0; k < full; ++k)
			to->full_block[b * full + k] =
				from->full_block[k] >= 0 ? from->full_block[k] + b * blocks : ~(~from->full_block[k] + b * blocks);
	}
}

typedef struct QpBoxes {
	int cells[3], copies; ///< cubes of 0.1 m
	double dt, young;     ///< [s], [Pa]
	int clamp;            ///< FACE_..., of all copies
} QpBoxes;

/// `copies` equal boxes, density 1000 kg/m^3, at rest; the boxes lie in the same place, contacts say who is where.
static inline void qp_case_boxes(QpCase* c, QpBoxes def) {
	ModelCase model;
	Rig rig;
	*c = (QpCase){0};
	case_box(&model, 0, "linear");
	for (int axis = 0; axis < 3; ++axis) {
		model.box.cells[axis] = def.cells[axis];
		model.box.size[axis] = 0.1 * def.cells[axis];
	}
	model.material.young = def.young;
	model.body.fix.count = def.clamp != FACE_NONE;
	model.fix[0].where = face_select(def.clamp);
	rig_create(&rig, &model, 1);
	assert_int_equal(rig.sys->ops->linearize(rig.sys, &rig.start), JN_OK);
	const double* stiffness = jn_stiffness_blocks((JnModelSystem*)rig.sys, JN_EXACT);
	const JnPattern* pattern = &rig.model->pattern;
	qp_repeat_pattern(c, pattern, def.copies);
	QP_TAKE(c, blocks, 9 * c->pattern.blocks), QP_TAKE(c, held, 3 * c->pattern.nodes);
	QP_TAKE(c, place, 3 * c->pattern.nodes);
	for (int b = 0; b < def.copies; ++b) {
		memcpy(c->held + b * rig.length, rig.model->held, (size_t)rig.length * sizeof *c->held);
		memcpy(c->place + b * rig.length, rig.model->rest, (size_t)rig.length * sizeof *c->place);
		double* blocks = c->blocks + 9 * (size_t)b * (size_t)pattern->blocks;
		for (int k = 0; k < 9 * pattern->blocks; ++k)
			blocks[k] = def.dt * def.dt * stiffness[k] + (k % 9 % 4 == 0 ? rig.model->mass[k / 9] : 0);
	}
	rig_destroy(&rig);
	c->body_pattern = qp_first_body(&c->pattern, c->pattern.nodes / def.copies);
	qp_case_finish(c, def.copies);
}

static inline void qp_case_destroy(QpCase* c) {
	jn_solver_direct.destroy(c->solver);
	for (int b = 0; b < c->problem.body_count; ++b) jn_solver_direct.destroy(c->halves[b]);
	jn_arena_free(&c->arena);
}

/// One more contact between `count` nodes, with that normal (any length), g and mu. Returns its number.
static inline int qp_touch(QpCase* c, int count, const int* nodes, const double* weights, const double* normal,
						   double bound, double mu) {
	const int i = c->problem.count++;
	const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
	double* f = c->frame[i];
	for (int a = 0; a < 3; ++a) f[a] = normal[a] / length;
	const double sign = f[2] >= 0 ? 1 : -1, s = -1 / (sign + f[2]), p = f[0] * f[1] * s; // Duff et al. 2017
	f[3] = 1 + sign * f[0] * f[0] * s, f[4] = sign * p, f[5] = -sign * f[0];
	f[6] = p, f[7] = sign + f[1] * f[1] * s, f[8] = -f[1];
	for (int k = 0; k < count; ++k) {
		c->node[c->start[i] + k] = nodes[k];
		c->weight[c->start[i] + k] = weights[k];
	}
	c->start[i + 1] = c->start[i] + count;
	c->bound[i][0] = bound;
	c->bound[i][1] = c->bound[i][2] = 0;
	c->friction[i] = mu;
	return i;
}

/// Random contacts between one to five random nodes, half of them violated at vp = 0 at the start.
static inline void qp_touch_random(QpCase* c, int count, double mu, uint64_t* seed) {
	for (int i = 0; i < count; ++i) {
		int nodes[5];
		double weights[5], normal[3];
		const int first = (int)(0.5 * (random_number(seed) + 1) * c->problem.nodes), many = 1 + i % 5;
		for (int k = 0; k < many; ++k) {
			nodes[k] = (first + 3 * k) % c->problem.nodes;
			weights[k] = k == 0 ? 1 : -1.0 / (many - 1);
		}
		fill_random(seed, 1, 3, normal);
		qp_touch(c, many, nodes, weights, normal, 0.1 * random_number(seed), mu);
	}
}

static inline bool qp_is_at(const QpCase* c, int node, int axis, double place) {
	return fabs(c->place[3 * node + axis] - place) < 1e-9;
}

/// A contact with ground that moves not, under every node of body `body` at the face z = 0. Returns how many.
static inline int qp_touch_ground(QpCase* c, int body, const double normal[3], double bound, double mu) {
	const double one = 1;
	int count = 0;
	for (int node = c->first_node[body]; node < c->first_node[body + 1]; ++node)
		if (qp_is_at(c, node, 2, 0)) qp_touch(c, 1, &node, &one, normal, bound, mu), ++count;
	return count;
}

/// Body `upper` stands on body `lower`: each node of its face z = 0 on the four nodes of the lower body's top around the
/// point beside it, shifted by (shift, shift) cells along x and y.
static inline void qp_touch_stacked(QpCase* c, int upper, int lower, double top, double shift, double mu) {
	static const double up[3] = {0, 0, 1};
	const int first = c->first_node[lower], last = c->first_node[lower + 1];
	for (int node = c->first_node[upper]; node < c->first_node[upper + 1]; ++node) {
		if (!qp_is_at(c, node, 2, 0)) continue;
		int nodes[5] = {node}, count = 1;
		double weights[5] = {1};
		for (int other = first; other < last && count < 5; ++other) {
			if (!qp_is_at(c, other, 2, top)) continue;
			double weight = 1;
			for (int axis = 0; axis < 2; ++axis)
				weight *= fmax(0, 1 - fabs(c->place[3 * node + axis] / 0.1 + shift - c->place[3 * other + axis] / 0.1));
			if (weight > 1e-9) nodes[count] = other, weights[count++] = -weight;
		}
		double sum = 0;
		for (int k = 0; k < count; ++k) sum += weights[k];
		if (fabs(sum) < 1e-9) qp_touch(c, count, nodes, weights, up, 0, mu); // else it stands beside the lower body
	}
}

static inline void qp_case_velocity(QpCase* c, int body, double x, double y, double z) {
	const double velocity[3] = {x, y, z};
	for (int k = 3 * c->first_node[body]; k < 3 * c->first_node[body + 1]; ++k)
		c->vp[k] = c->held[k] ? 0 : velocity[k % 3];
}

typedef struct QpWall {
	int per_layer, layers;
	int side, height; ///< cells of a box
	double young, mu; ///< [Pa]
} QpWall;

/// Boxes in layers that fall on the ground, each on a corner of one and on an edge of another of the layer below; dt = 10 ms.
static inline void qp_case_wall(QpCase* c, QpWall def) {
	static const double up[3] = {0, 0, 1};
	uint64_t seed = 3;
	const double top = 0.1 * def.height, half = 0.5 * def.side;
	qp_case_boxes(c,
				  (QpBoxes){{def.side, def.side, def.height}, def.per_layer * def.layers, 0.01, def.young, FACE_NONE});
	for (int b = 0; b < c->problem.body_count; ++b)
		qp_case_velocity(c, b, 0.3 * random_number(&seed), 0.1 * random_number(&seed),
						 -0.2 - 0.1 * (b / def.per_layer));
	for (int k = 0; k < 3 * c->pattern.nodes; ++k) c->vp[k] += 0.05 * random_number(&seed);
	for (int b = 0; b < c->problem.body_count; ++b) {
		const int below = b - def.per_layer;
		if (below < 0) qp_touch_ground(c, b, up, 0, def.mu);
		if (below >= 0) qp_touch_stacked(c, b, below, top, half + 0.2, def.mu);
		if (below >= 0 && (below + 1) % def.per_layer > 0) qp_touch_stacked(c, b, below + 1, top, 0.3 - half, def.mu);
	}
}

/// Solve from lambda = 0 into c->v and c->lambda; returns the outcome.
static inline JnStatus qp_case_solve(QpCase* c, const JnQpType* type, double tolerance) {
	const JnQpDef options = {.tolerance = tolerance, .max_iterations = 5000};
	JnQp* qp = NULL;
	assert_int_equal(jn_qp_create(type, &options, &qp), JN_OK);
	memset(c->lambda, 0, 3 * (size_t)c->problem.count * sizeof *c->lambda);
	const JnStatus status = jn_qp_solve(qp, &c->problem, c->v, c->lambda, &c->report);
	jn_qp_destroy(qp);
	return status;
}

static inline void qp_print(const char* what, const QpCase* c) {
	const JnContactResidual* r = &c->report.residual;
	print_error(
		"%s: %d contacts, %d rows: iterations %d, sweeps %d, factorizations %d, solves %d; stationarity %.1e, primal "
		"%.1e, dual %.1e, complementarity %.1e, friction %.1e\n",
		what, c->problem.count, c->report.rows, c->report.iterations, c->report.sweeps, c->report.factorizations,
		c->report.solves, r->stationarity, r->primal, r->dual, r->complementarity, r->friction);
}

/// Solve, and fail unless it converges.
static inline void qp_case_expect(QpCase* c, const JnQpType* type, double tolerance) {
	const JnStatus status = qp_case_solve(c, type, tolerance);
	if (status == JN_OK) return;
	qp_print(type->row.name, c);
	fail_msg("%s: %s at tolerance %.1e", type->row.name, jn_status_name(status), tolerance);
}

static const JnQpType* const qp_types[] = {&jn_qp_delassus, &jn_qp_admm, &jn_qp_auto};
enum { QP_TYPES = sizeof qp_types / sizeof *qp_types };

#endif
