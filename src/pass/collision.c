// The verbs of collision: impulses between what touches, after the integrator (EX, "Simulation update logic", steps 2 and 4).
//
// Positions: x = xp + M^-1 J^T mu, so that nothing overlaps and what rubs without sliding has not moved since the start.
// Velocities: v = vp + M^-1 J^T lambda, so that nothing approaches. M: the lumped masses, infinite where nodes are held.
//
// A share of the forces lambda / dt, the residue, acts on in the next step as a constant load, so that the integrator
// carries what lasts. Of a load F a method of order 1 makes F dt^2 / m of the positions, others half of that; impulses that
// last put that and F dt / m of the velocities back as they were.
#include "pass/collision.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
	LOOKS = 4,         // further ones, where impulses lead
	MANY_SWEEPS = 100, // which resolve stacks of some ten threads
};

static const double longest_carry = 10; // times the impulses of a step much shorter than the one in which they act
static const double too_deep = 0.5;     // of the distance at which two touch: overlap that fails an attempt
static const double harmless = 0.1;     // likewise: overlap that sweeps push out without throwing anything

static JnCollision* of(JnPass* pass) {
	return (JnCollision*)pass;
}

// Of the last step's impulses, the share that acts as impulses in this one.
static double carried_share(const JnCollision* pass, const JnStep* step) {
	return pass->def->residue * fmin(step->dt / pass->kept.dt, longest_carry);
}

static void find_load(JnCollision* pass, const JnStep* step) {
	const JnImpulses* kept = &pass->kept;
	memset(pass->load, 0, 3 * (size_t)pass->model->node_count * sizeof *pass->load);
	for (int i = 0; i < kept->count; ++i)
		jn_block_push(kept, &kept->blocks[i], kept->blocks[i].impulse[JN_LEVEL_VELOCITY],
					  carried_share(pass, step) / step->dt, NULL, pass->load);
}

static JnStatus prepare(JnPass* base, const JnStep* step, int round) {
	JnCollision* pass = of(base);
	(void)round;
	pass->has_failed = false; // what is said of an attempt is not of one before
	pass->ran_away = 0;
	pass->is_loaded = pass->def->residue > 0 && pass->last.pressing + pass->last.sites > 0;
	if (pass->is_loaded) find_load(pass, step);
	jn_model_system_set_load(pass->model, JN_LOAD_OF_COLLISION, pass->is_loaded ? pass->load : NULL);
	return JN_OK;
}

// What the residue has done to the prediction is taken back, so that impulses are found whole: where nothing changes they put
// it back again.
static void take_back(JnCollision* pass, JnStep* step) {
	const JnImpulses* kept = &pass->kept;
	const double share = -carried_share(pass, step), lever = step->method->order > 1 ? 0.5 : 1;
	for (int i = 0; i < kept->count; ++i) {
		const double* lambda = kept->blocks[i].impulse[JN_LEVEL_VELOCITY];
		jn_block_push(kept, &kept->blocks[i], lambda, share, pass->inverse_mass, step->end->v);
		jn_block_push(kept, &kept->blocks[i], lambda, share * step->dt * lever, pass->inverse_mass, step->end->x);
	}
}

// Velocities are those of contacts that press.
static void choose_active(JnCollision* pass) {
	for (int i = 0; i < pass->now.count; ++i) {
		JnBlock* block = &pass->now.blocks[i];
		block->is_active = block->kind == JN_BLOCK_SITE || block->impulse[JN_LEVEL_POSITION][0] > 0;
		if (!block->is_active) memset(block->impulse[JN_LEVEL_VELOCITY], 0, sizeof block->impulse[0]);
	}
}

// The work of impulses is taken over the mean of the relative velocities at both ends of the step: of a blow it is what the
// blow changes of the kinetic energy, of what rests nothing, of what slides what friction takes.
static void tally(JnCollision* pass, const JnStep* step) {
	JnCollisionTally* tally = &pass->tally;
	for (int i = 0; i < pass->now.count; ++i) {
		const JnBlock* block = &pass->now.blocks[i];
		const double* lambda = block->impulse[JN_LEVEL_VELOCITY];
		double x[3], from[3], to[3];
		if (block->kind == JN_BLOCK_SITE) {
			++tally->sites;
			continue;
		}
		jn_block_motion(&pass->now, block, step->end->x, x);
		jn_block_motion(&pass->now, block, step->start->v, from);
		jn_block_motion(&pass->now, block, step->end->v, to);
		tally->overlap = fmax(tally->overlap, block->touch - x[0]);
		const double missed = block->target[JN_LEVEL_POSITION][0] - x[0];
		if (missed > pass->missed) pass->missed = missed, pass->missed_at = pass->now.entries[block->first].node;
		tally->pressing += lambda[0] > 0;
		tally->impulse += lambda[0];
		for (int r = 0; r < 3; ++r) tally->work += 0.5 * lambda[r] * (from[r] + to[r]);
	}
}

static JnStatus find(JnCollision* pass, const JnStep* step) {
	JN_TRY(jn_collision_watch(pass, step));
	JN_TRY(jn_collision_find(pass, step));
	if (pass->guest.user != NULL) JN_TRY(pass->guest.collect(pass->guest.user, step, &pass->now));
	jn_impulses_finish(&pass->now, pass->inverse_mass);
	return JN_OK;
}

static void solve(JnCollision* pass, JnLevel level, double* y) {
	pass->tally.sweeps +=
		jn_impulses_solve(&pass->now, level, pass->inverse_mass, pass->def->iterations, pass->def->tolerance, y);
}

// Whether impulses have moved a point so far that it may have met something else, and overlaps it by more than the margin.
static bool has_moved(JnCollision* pass, const JnStep* step) {
	const int points = pass->frame_count + pass->vertex_count;
	jn_collision_points(pass, step->end->x, pass->moved);
	return jn_collision_farthest(points, pass->moved, pass->end) > 4 * pass->margin * pass->margin;
}

// Fast things are thrown onto others by the impulses themselves: look where these have led, and push further. *is_known: the
// points at the end are in pass->moved.
static JnStatus solve_positions(JnCollision* pass, JnStep* step, bool* is_known) {
	int looks = 0;
	solve(pass, JN_LEVEL_POSITION, step->end->x);
	pass->moved_stamp = 0;
	for (; looks < LOOKS && has_moved(pass, step); ++looks) {
		const JnImpulses before = pass->now;
		pass->now = pass->seen;
		pass->seen = before;
		JN_TRY(find(pass, step));
		solve(pass, JN_LEVEL_POSITION, step->end->x);
		jn_impulses_join(&pass->now, &pass->seen);
	}
	*is_known = looks < LOOKS;
	return JN_OK;
}

static bool does_nothing(const JnCollision* pass) {
	for (int i = 0; i < pass->now.count; ++i) {
		const double(*impulse)[3] = (const double(*)[3])pass->now.blocks[i].impulse;
		for (int r = 0; r < 3; ++r)
			if (impulse[0][r] != 0 || impulse[1][r] != 0) return false;
	}
	return !pass->is_loaded;
}

static JnStatus correct(JnPass* base, JnStep* step, int round, bool* edited, bool* again) {
	JnCollision* pass = of(base);
	(void)round, (void)again;
	pass->tally = (JnCollisionTally){0};
	pass->missed = 0;
	if (pass->is_loaded) take_back(pass, step);
	JN_TRY(find(pass, step));
	if (pass->now.count == 0 && !pass->is_loaded) return JN_OK;
	jn_impulses_warm(&pass->now, &pass->kept);
	bool is_known = false;
	JN_TRY(solve_positions(pass, step, &is_known));
	choose_active(pass);
	solve(pass, JN_LEVEL_VELOCITY, step->end->v);
	tally(pass, step);
	*edited = !does_nothing(pass);
	if (*edited) jn_state_touch(pass->sys->base.space, step->end);
	if (is_known) pass->moved_stamp = step->end->stamp;
	pass->has_failed = pass->missed > too_deep * pass->largest_radius;
	return pass->has_failed ? JN_NOT_CONVERGED : JN_OK;
}

// The blocks become those of the last step, and the arrays change places.
static void commit(JnPass* base, const JnStep* step) {
	JnCollision* pass = of(base);
	const JnImpulses blocks = pass->kept;
	(void)step;
	pass->kept = pass->now;
	pass->now = blocks;
	pass->total_work += pass->tally.work;
	pass->last = pass->tally;
}

// The impulses of the step over its length; what was a load of it, the residue, is among the loads of the system.
static void react(const JnPass* base, double* force) {
	const JnCollision* pass = (const JnCollision*)base;
	const JnImpulses* kept = &pass->kept;
	for (int i = 0; i < kept->count; ++i)
		jn_block_push(kept, &kept->blocks[i], kept->blocks[i].impulse[JN_LEVEL_VELOCITY], 1 / kept->dt, NULL, force);
	if (!pass->is_loaded) return;
	for (int k = 0; k < 3 * pass->model->node_count; ++k) force[k] -= pass->load[k];
}

static void archive_collision(JnPass* base, JnArchive* archive) {
	JnCollision* pass = of(base);
	jn_impulses_archive(&pass->kept, archive, pass->model->node_count);
	jn_archive_switch(archive, "is_loaded", &pass->is_loaded);
	jn_archive_reals(archive, "load", pass->load, 3 * (size_t)pass->model->node_count);
	jn_archive_bytes(archive, "collision", &pass->last, sizeof pass->last);
	jn_archive_real(archive, "work", &pass->total_work);
	jn_model_system_set_load(pass->model, JN_LOAD_OF_COLLISION, pass->is_loaded ? pass->load : NULL);
}

static void explain(const JnPass* base, JnPassComplaint* out) {
	const JnCollision* pass = (const JnCollision*)base;
	if (pass->ran_away > 0) {
		snprintf(out->cause, sizeof out->cause,
				 "in collision, where something moves by %.2g m within the step, more than %d times the length of the "
				 "shortest thread, %.2g m",
				 pass->ran_away, JN_COLLISION_TOO_FAR, pass->extent);
		out->share = pass->extent / pass->ran_away;
	} else if (pass->has_failed) {
		snprintf(out->cause, sizeof out->cause,
				 "in collision, where sweeps leave %.2g m of overlap, more than %g radii, %.2g m", pass->missed,
				 too_deep, too_deep * pass->largest_radius);
		out->node = pass->missed_at;
		out->share = harmless * pass->largest_radius / pass->missed;
		if (pass->def->iterations < MANY_SWEEPS)
			snprintf(out->remedy, sizeof out->remedy, "collision.iterations: %d", MANY_SWEEPS);
	}
}

static const JnPassColumn columns[] = {
	{"collisions", "", true},          {"collision_sweeps", "", true},
	{"collision_overlap", "m", false}, {"collision_impulse", "N s", false},
	{"collision_work", "J", false},
};

static void measure(const JnPass* base, double* values) {
	const JnCollision* pass = (const JnCollision*)base;
	const JnCollisionTally* last = &pass->last;
	const double all[] = {last->pressing, last->sweeps, last->overlap, last->impulse, pass->total_work};
	memcpy(values, all, sizeof all);
}

const JnPassType jn_pass_collision = {
	.row = {.name = "collision",
			.doc = "impulses where threads meet themselves, each other, bodies and obstacles",
			.keys = jn_collision_keys,
			.options_size = sizeof(JnCollisionDef)},
	.definition = offsetof(JnSimDef, collision),
	.create = jn_collision_create,
	.destroy = jn_collision_destroy,
	.prepare = prepare,
	.correct = correct,
	.commit = commit,
	.react = react,
	.explain = explain,
	.archive = archive_collision,
	.column_count = sizeof columns / sizeof *columns,
	.columns = columns,
	.measure = measure,
};
