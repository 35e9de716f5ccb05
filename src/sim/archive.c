// Saving a simulation and going on from there.
//
// Bits depend on more than the state: on tangents and factors of earlier steps, on lists of what is near, on what solvers
// have learned. Instead of saving these, a simulation that is saved drops them, and one that is restored begins without them:
// both are built anew and read the same archive.
#include <math.h>
#include <string.h>

#include "base/hash.h"
#include "base/log.h"
#include "base/space.h"
#include "model/model.h"
#include "model/system.h"
#include "sim/simulation.h"

// Of what states and history are: a restored simulation must have the same nodes, elements, method and rules.
static JnHash fingerprint(const JnSim* sim) {
	const JnModel* model = sim->model;
	const size_t length = sim->sys->space->length;
	const char* const names[] = {sim->def->integrator.row->name, sim->def->step.row->name};
	JnHash hash = jn_hash_add(jn_hash_start(), &length, sizeof length);
	for (int i = 0; i < 2; ++i) hash = jn_hash_add(hash, names[i], strlen(names[i]) + 1);
	for (int i = 0; i < sim->passes.count; ++i) {
		const char* name = sim->passes.list[i]->type->row.name;
		hash = jn_hash_add(hash, name, strlen(name) + 1);
	}
	if (model == NULL) return hash;
	hash = jn_hash_add(hash, model->rest, length * sizeof *model->rest);
	for (int b = 0; b < model->body_count; ++b) {
		const JnBody* body = &model->bodies[b];
		const size_t nodes = (size_t)jn_shape_info[body->mesh.shape].nodes;
		hash = jn_hash_add(hash, body->cells, (size_t)body->mesh.cell_count * nodes * sizeof *body->cells);
	}
	return jn_hash_add(hash, model->held, length * sizeof *model->held);
}

static void check_fingerprint(const JnSim* sim, JnArchive* archive) {
	const JnHash own = fingerprint(sim);
	JnHash found = own;
	jn_archive_bytes(archive, "fingerprint", &found, sizeof found);
	if (archive->status == JN_OK && found != own)
		archive->status = jn_error(JN_BAD_INPUT, "the saved state is of another scene: its nodes, elements, method, "
												 "controller or passes differ from those of this one");
}

static void archive_state(JnSim* sim, JnArchive* archive) {
	const size_t length = sim->sys->space->length;
	jn_archive_real(archive, "t", &sim->start.t);
	jn_archive_reals(archive, "x", sim->start.x, length);
	jn_archive_reals(archive, "v", sim->start.v, length);
	jn_archive_real(archive, "next_dt", &sim->next_dt);
	jn_archive_real(archive, "last_dt", &sim->last_dt);
	jn_archive_real(archive, "stop", &sim->stop);
	jn_archive_switch(archive, "was_edited", &sim->was_edited);
	jn_archive_long(archive, "steps", &sim->steps);
}

static void archive_parts(JnSim* sim, JnArchive* archive) {
	archive_state(sim, archive);
	jn_system_archive(sim->sys, archive);
	jn_integrator_archive(sim->integrator, archive);
	jn_controller_archive(sim->controller, archive);
	jn_passes_archive(&sim->passes, archive);
	jn_watch_archive(sim, archive);
}

JnStatus jn_sim_snapshot(JnSim* sim, JnArchive* archive) {
	check_fingerprint(sim, archive);
	if (sim->model != NULL) jn_model_archive(sim->model, archive);
	archive_parts(sim, archive);
	return archive->status;
}

static JnStatus check_read(JnSim* sim, const JnArchive* archive) {
	JN_TRY(archive->status);
	JN_TRY(jn_state_check(sim->sys->space, &sim->start) == JN_OK
			   ? JN_OK
			   : jn_error(JN_BAD_INPUT, "the saved state does not fit: positions or velocities are not finite"));
	const bool is_sound = isfinite(sim->start.t) && sim->next_dt > 0 && isfinite(sim->next_dt) && sim->steps >= 0;
	return is_sound ? JN_OK : jn_error(JN_BAD_INPUT, "the saved state does not fit: its time or step is absurd");
}

JnStatus jn_sim_restore(JnSim* sim, JnArchive* archive) {
	check_fingerprint(sim, archive);
	if (archive->status == JN_OK && sim->model != NULL) jn_model_archive(sim->model, archive);
	JN_TRY(archive->status);
	JN_TRY(jn_sim_renew(sim));
	archive_parts(sim, archive);
	JN_TRY(check_read(sim, archive));
	jn_state_touch(sim->sys->space, &sim->start);
	sim->report = (JnReport){0};
	sim->sys->report = &sim->report;
	return sim->sys->ops->begin(sim->sys, &sim->start);
}

JnStatus jn_sim_save(JnSim* sim, JnArchive* archive) {
	const size_t begin = archive->size;
	JN_TRY(jn_sim_snapshot(sim, archive));
	JnArchive own = jn_archive_reader(archive->bytes + begin, archive->size - begin);
	return jn_sim_restore(sim, &own);
}

void jn_sim_restart_step(JnSim* sim) {
	sim->next_dt = sim->controller->type->first(sim->controller);
}
