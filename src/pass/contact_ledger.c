// What contact came to: works, gaps and counters, and how they are recorded.
#include <math.h>
#include <string.h>

#include "pass/contact.h"

double jn_contact_energy(const JnContactPass* pass, const JnState* state) {
	const JnEnergies e = jn_model_energies(pass->model, state);
	return e.kinetic + e.elastic + e.gravity;
}

double jn_contact_work(const JnContactPass* pass, const double* force, const JnStep* step, bool on_held) {
	double sum = 0;
	for (size_t k = 0; k < jn_contact_entries(pass); ++k)
		if (pass->model->held[k] == on_held) sum += force[k] * (step->end->x[k] - step->start->x[k]);
	return sum;
}

// work = x1 - x0
static void find_displacements(JnContactPass* pass, const JnStep* step) {
	for (size_t k = 0; k < jn_contact_entries(pass); ++k) pass->work[k] = step->end->x[k] - step->start->x[k];
}

static void tally_rows(JnContactPass* pass, const JnStep* step) {
	const JnContactRows* rows = &pass->now;
	const JnContactProblem problem = jn_contact_geometry(rows);
	find_displacements(pass, step);
	for (int i = 0; i < rows->count; ++i) {
		double moved[3];
		jn_contact_velocity(&problem, i, pass->work, moved);
		pass->tally.deepest = fmin(pass->tally.deepest, rows->gap[i] + moved[0]);
		pass->tally.normal_work += rows->lambda[i][0] * moved[0] / step->dt;
		pass->tally.friction_work += (rows->lambda[i][1] * moved[1] + rows->lambda[i][2] * moved[2]) / step->dt;
	}
}

void jn_contact_find_gaps(JnContactPass* pass, const JnStep* step) {
	const JnContactRows* rows = &pass->now;
	const JnContactProblem problem = jn_contact_geometry(rows);
	for (int node = 0; node < pass->model->node_count; ++node) pass->gap[node] = pass->margin;
	find_displacements(pass, step);
	for (int i = 0; i < rows->count; ++i) {
		double moved[3];
		jn_contact_velocity(&problem, i, pass->work, moved);
		for (int k = rows->start[i]; k < rows->start[i + 1]; ++k)
			if (rows->weight[k] > 0) pass->gap[rows->node[k]] = fmin(pass->gap[rows->node[k]], rows->gap[i] + moved[0]);
	}
}

void jn_contact_tally(JnContactPass* pass, const JnStep* step, double before) {
	JnContactTally* tally = &pass->tally;
	tally_rows(pass, step);
	tally->drive_work = -jn_contact_work(pass, pass->force, step, true);
	const double after = jn_contact_energy(pass, step->end);
	tally->loss = after - before - tally->normal_work - tally->friction_work - tally->drive_work;
}

void jn_contact_tally_add(const JnContactTally* step, JnContactTally* total) {
	const JnContactTally before = *total;
	*total = *step;
	total->normal_work += before.normal_work;
	total->friction_work += before.friction_work;
	total->drive_work += before.drive_work;
	total->loss += before.loss;
}

const JnPassColumn jn_contact_columns[JN_CONTACT_COLUMNS] = {
	{"contact_pairs", "", true},   {"contacts", "", true},       {"contacts_pressing", "", true},
	{"contact_rounds", "", true},  {"qp_iterations", "", true},  {"qp_residual", "", false},
	{"penetration", "m", false},   {"contact_work", "J", false}, {"friction_work", "J", false},
	{"contact_drive", "J", false}, {"contact_loss", "J", false},
};

void jn_contact_measure(const JnPass* base, double* values) {
	const JnContactTally* t = &((const JnContactPass*)base)->total;
	const double all[] = {(double)t->pairs, t->contacts,    t->pressing,      t->rounds,     t->iterations, t->residual,
						  -t->deepest,      t->normal_work, t->friction_work, t->drive_work, t->loss};
	memcpy(values, all, sizeof all);
}

const JnPassField jn_contact_fields[JN_CONTACT_FIELDS] = {{"contact_force", "N", 3}, {"gap", "m", 1}};

const double* jn_contact_field(const JnPass* base, int index) {
	const JnContactPass* pass = (const JnContactPass*)base;
	return index == 0 ? pass->load : pass->gap;
}
