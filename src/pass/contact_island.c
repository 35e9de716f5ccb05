// Islands: bodies that contacts connect. Only those in which some contact would be violated, or in which impulses of the
// last step act, take part; each island is a problem of its own.
#include <math.h>
#include <string.h>

#include "pass/contact.h"

static int root_of(int* parent, int body) {
	while (parent[body] != body) body = parent[body] = parent[parent[body]];
	return body;
}

static void join(int* parent, int a, int b) {
	a = root_of(parent, a);
	b = root_of(parent, b);
	parent[a > b ? a : b] = a > b ? b : a;
}

// Bodies of a contact; the second is -1 for obstacles.
static void bodies_of(const JnContactPass* pass, const JnContact* contact, int bodies[2]) {
	bodies[0] = pass->skins[contact->vertex_skin].body;
	bodies[1] = contact->other_skin == JN_OBSTACLE_SKIN ? -1 : pass->skins[contact->other_skin].body;
}

// Does the prediction violate the contact, or has it impulses to begin with?
static bool is_active(const JnContactRows* rows, int i, const double* v) {
	const JnContactProblem one = jn_contact_geometry(rows);
	double u[3];
	jn_contact_velocity(&one, i, v, u);
	return u[0] < rows->bound[i][0] || rows->lambda[i][0] > 0;
}

static void connect(JnContactPass* pass) {
	const JnContactRows* rows = &pass->now;
	for (int b = 0; b < pass->model->body_count; ++b) pass->parent[b] = b;
	for (int i = 0; i < rows->count; ++i) {
		int bodies[2];
		bodies_of(pass, &rows->contact[i], bodies);
		if (bodies[1] >= 0 && bodies[1] != bodies[0]) join(pass->parent, bodies[0], bodies[1]);
	}
}

// The load of the last step acts on a body.
static bool carries_load(const JnContactPass* pass, int body) {
	const double* load = pass->tried + jn_contact_first_entry(pass, body);
	for (size_t k = 0; pass->is_loaded && k < jn_contact_entry_count(pass, body); ++k)
		if (load[k] != 0) return true;
	return false;
}

int jn_contact_islands_find(JnContactPass* pass, const JnStep* step) {
	const int bodies = pass->model->body_count;
	JnContactRows* rows = &pass->now;
	connect(pass);
	for (int b = 0; b < bodies; ++b) pass->moves[b] = false;
	for (int b = 0; b < bodies; ++b) // marks of roots at first
		if (carries_load(pass, b)) pass->moves[root_of(pass->parent, b)] = true;
	for (int i = 0; i < rows->count; ++i) {
		const int body = pass->skins[rows->contact[i].vertex_skin].body;
		if (is_active(rows, i, step->end->v)) pass->moves[root_of(pass->parent, body)] = true;
	}
	int islands = 0;
	for (int b = 0; b < bodies; ++b) {
		const int root = root_of(pass->parent, b);
		pass->island_of[b] = !pass->moves[root] ? -1 : root == b ? islands++ : pass->island_of[root];
	}
	for (int b = 0; b < bodies; ++b) pass->moves[b] = pass->island_of[b] >= 0;
	for (int i = 0; i < rows->count; ++i)
		rows->island[i] = pass->island_of[pass->skins[rows->contact[i].vertex_skin].body];
	return islands;
}

// Copy the rows of an island behind each other.
static JnStatus gather(JnContactPass* pass, int island) {
	const JnContactRows* all = &pass->now;
	JnContactRows* part = &pass->part;
	JN_TRY(jn_contact_rows_reserve(part, all->count, all->start[all->count]));
	part->start[0] = 0;
	for (int i = 0; i < all->count; ++i) {
		if (all->island[i] != island) continue;
		const int k = part->count++, first = all->start[i], nodes = all->start[i + 1] - first;
		memcpy(part->node + part->start[k], all->node + first, (size_t)nodes * sizeof *part->node);
		memcpy(part->weight + part->start[k], all->weight + first, (size_t)nodes * sizeof *part->weight);
		memcpy(part->frame[k], all->frame[i], sizeof part->frame[k]);
		memcpy(part->bound[k], all->bound[i], sizeof part->bound[k]);
		memcpy(part->lambda[k], all->lambda[i], sizeof part->lambda[k]);
		part->start[k + 1] = part->start[k] + nodes;
		part->friction[k] = all->friction[i];
		part->source[k] = i;
	}
	return JN_OK;
}

// Let the bodies of the island, and no others, move.
static void set_bodies(JnContactPass* pass, int island, bool is_in) {
	const JnModel* model = pass->model;
	for (int b = 0; b < model->body_count; ++b) {
		if (pass->island_of[b] != island) continue;
		const size_t first = jn_contact_first_entry(pass, b), count = jn_contact_entry_count(pass, b);
		pass->is_in[b] = is_in;
		for (size_t k = first; k < first + count; ++k) pass->held[k] = !is_in || model->held[k];
	}
}

static JnContactProblem problem_of(JnContactPass* pass) {
	const JnContactRows* part = &pass->part;
	return (JnContactProblem){.nodes = pass->model->node_count,
							  .matrix = jn_contact_matrix(pass),
							  .held = pass->held,
							  .vp = pass->free_v,
							  .body_count = pass->model->body_count,
							  .first_node = pass->first_node,
							  .count = part->count,
							  .start = part->start,
							  .node = part->node,
							  .weight = part->weight,
							  .frame = (const double(*)[9])part->frame,
							  .bound = (const double(*)[3])part->bound,
							  .friction = part->friction};
}

static void tally(JnContactPass* pass, const JnQpReport* report) {
	JnContactTally* tally = &pass->tally;
	tally->iterations += report->iterations + report->sweeps;
	tally->residual = fmax(tally->residual, jn_contact_residual_max(&report->residual));
	for (int i = 0; i < pass->part.count; ++i) tally->pressing += pass->part.lambda[i][0] > 0;
}

static void keep_velocities(JnContactPass* pass, const double* v) {
	for (int b = 0; b < pass->model->body_count; ++b) {
		if (!pass->is_in[b]) continue;
		const size_t first = jn_contact_first_entry(pass, b);
		memcpy(pass->v + first, v + first, jn_contact_entry_count(pass, b) * sizeof *v);
	}
}

// The contact that is worst, by violation of its bound and complementarity, at velocities v.
static int find_worst(const JnContactProblem* problem, const double* v, const double* lambda) {
	double most = -1;
	int worst = 0;
	for (int i = 0; i < problem->count; ++i) {
		double u[3];
		jn_contact_velocity(problem, i, v, u);
		const double gap = u[0] - problem->bound[i][0];
		const double wrong = jn_contact_row_scale(problem, i) * (gap < 0 || lambda[3 * i] > 0 ? fabs(gap) : 0);
		if (wrong > most) most = wrong, worst = i;
	}
	return worst;
}

JnStatus jn_contact_island_solve(JnContactPass* pass, int island) {
	JN_TRY(gather(pass, island));
	set_bodies(pass, island, true);
	const JnContactProblem problem = problem_of(pass);
	JnQpReport report;
	if (pass->observer != NULL) pass->observer(pass->observer_user, &problem, &pass->part.lambda[0][0]);
	const JnStatus status = jn_qp_solve(pass->qp, &problem, pass->solved, &pass->part.lambda[0][0], &report);
	keep_velocities(pass, pass->solved);
	set_bodies(pass, island, false);
	if (status > JN_OK) {
		const int worst = find_worst(&problem, pass->solved, &pass->part.lambda[0][0]);
		pass->worst = pass->now.contact[pass->part.source[worst]];
		pass->has_failed = true;
		pass->tally.residual = jn_contact_residual_max(&report.residual);
	}
	JN_TRY(status);
	for (int i = 0; i < pass->part.count; ++i)
		memcpy(pass->now.lambda[pass->part.source[i]], pass->part.lambda[i], sizeof pass->part.lambda[i]);
	tally(pass, &report);
	return JN_OK;
}
