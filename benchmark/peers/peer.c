#include "peer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_SETS = 32 };

static JnStatus complain(const char* what) {
	fprintf(stderr, "%s\n", what);
	return JN_BAD_INPUT;
}

static JnStatus build(Peer* peer, const char* path, int set_count, const char* const* sets) {
	JN_TRY(jn_scene_load(path, set_count, sets, &peer->scene));
	JN_TRY(jn_scene_build(peer->scene, 1, &peer->sim));
	peer->sys = jn_sim_system(peer->sim);
	peer->sys->report = &peer->report;
	JnSpace* space = peer->sys->space;
	peer->n = space->length;
	peer->state.x = space->ops->create(space);
	peer->state.v = space->ops->create(space);
	if (peer->state.x == NULL || peer->state.v == NULL) return JN_OUT_OF_MEMORY;
	const JnState* start = jn_sim_state(peer->sim);
	memcpy(peer->state.x, start->x, peer->n * sizeof(double));
	memcpy(peer->state.v, start->v, peer->n * sizeof(double));
	jn_state_touch(space, &peer->state);
	return JN_OK;
}

JnStatus peer_open(Peer* peer, int count, char** arguments) {
	const char *path = NULL, *frames = NULL, *sets[MOST_SETS];
	int set_count = 0;
	*peer = (Peer){.span = 1, .samples = 1, .words = arguments};
	for (int i = 1; i < count; ++i) {
		if (strncmp(arguments[i], "--", 2) != 0) {
			peer->words[peer->word_count++] = arguments[i];
			continue;
		}
		const char *name = arguments[i] + 2, *value = i + 1 < count ? arguments[++i] : NULL;
		if (value == NULL) return complain("an option lacks its value");
		if (strcmp(name, "scene") == 0)
			path = value;
		else if (strcmp(name, "set") == 0 && set_count < MOST_SETS)
			sets[set_count++] = value;
		else if (strcmp(name, "span") == 0)
			peer->span = strtod(value, NULL);
		else if (strcmp(name, "samples") == 0)
			peer->samples = atoi(value);
		else if (strcmp(name, "frames") == 0)
			frames = value;
		else
			return complain("options are --scene, --set, --span, --samples, --frames");
	}
	if (path == NULL || peer->samples < 1 || !(peer->span > 0))
		return complain("--scene, --span and --samples are needed");
	peer->interval = peer->span / peer->samples;
	if (frames != NULL && (peer->frames = fopen(frames, "wb")) == NULL) return perror(frames), JN_IO_FAILED;
	return build(peer, path, set_count, sets);
}

void peer_close(Peer* peer) {
	if (peer->sys != NULL) {
		peer->sys->space->ops->destroy(peer->sys->space, peer->state.x);
		peer->sys->space->ops->destroy(peer->sys->space, peer->state.v);
	}
	if (peer->sim != NULL) jn_sim_destroy(peer->sim);
	if (peer->scene != NULL) jn_scene_destroy(peer->scene);
	if (peer->frames != NULL) fclose(peer->frames);
}

const char* peer_word(const Peer* peer, const char* name, const char* otherwise) {
	const size_t length = strlen(name);
	for (int i = 0; i < peer->word_count; ++i)
		if (strncmp(peer->words[i], name, length) == 0 && peer->words[i][length] == '=')
			return peer->words[i] + length + 1;
	return otherwise;
}

double peer_number(const Peer* peer, const char* name, double otherwise) {
	const char* word = peer_word(peer, name, NULL);
	return word != NULL ? strtod(word, NULL) : otherwise;
}

double peer_clock(void) {
	struct timespec now;
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void peer_resume(Peer* peer) {
	peer->resumed = peer_clock();
}

void peer_pause(Peer* peer) {
	peer->seconds += peer_clock() - peer->resumed;
}

void peer_write(Peer* peer, double t, const double* x, const double* v) {
	if (peer->frames == NULL) return;
	peer_pause(peer);
	fwrite(&t, sizeof t, 1, peer->frames);
	fwrite(x, sizeof *x, peer->n, peer->frames);
	fwrite(v, sizeof *v, peer->n, peer->frames);
	peer_resume(peer);
}

void peer_print(const char* name, double value) {
	printf("%s %.9g\n", name, value);
}

void peer_finish(const Peer* peer) {
	peer_print("seconds", peer->seconds);
	peer_print("forces", peer->report.forces);
	peer_print("factorizations", peer->report.factorizations);
	peer_print("iterations", peer->report.iterations > 0 ? peer->report.iterations : peer->report.solves);
}

// The verbs take a state that they do not change; its vectors are the foreign program's own.
static JnState state_of(Peer* peer, double t, const double* x, const double* v) {
	JnState s = {.t = t, .x = (double*)x, .v = (double*)v};
	jn_state_touch(peer->sys->space, &s);
	return s;
}

JnStatus peer_acceleration(Peer* peer, double t, const double* x, const double* v, double* out) {
	const JnState s = state_of(peer, t, x, v);
	JN_TRY(peer->sys->ops->force(peer->sys, &s, out));
	peer->sys->ops->hold(peer->sys, out);
	JnMatrix* mass = peer_matrix(peer, 1, 0, 0);
	return mass != NULL ? mass->ops->solve(mass, out, out) : JN_RUN_FAILED;
}

JnStatus peer_linearize(Peer* peer, double t, const double* x, const double* v) {
	const JnState s = state_of(peer, t, x, v);
	return peer->sys->ops->linearize(peer->sys, &s);
}

JnStatus peer_begin(Peer* peer, double t, const double* x, const double* v) {
	const JnState s = state_of(peer, t, x, v);
	return peer->sys->ops->begin(peer->sys, &s);
}

JnMatrix* peer_matrix(Peer* peer, double mass, double damping, double stiffness) {
	JnMatrix* matrix = NULL;
	const JnShift shift = {mass, damping, stiffness};
	return peer->sys->ops->matrix(peer->sys, shift, &matrix) == JN_OK ? matrix : NULL;
}
