// jounce beside its peers: a scene of ours, stepped as the scene says, and what peers are given of it.
//
//   peer_own run OPTIONS                    step the scene, write states
//   peer_own energies OPTIONS states=FILE   total energy of each state in the file, over the mass [J/kg]
//   peer_own mesh OPTIONS out=FILE          nodes, cells, masses, held nodes, material, gravity as lines of text
#include <string.h>

#include "export.h"
#include "solve/blas.h"

static JnStatus run(Peer* peer) {
	long newton = 0, rejected = 0, factorizations = 0, forces = 0, iterations = 0;
	peer_resume(peer);
	for (int k = 1; k <= peer->samples; ++k) {
		const double t = peer->span * k / peer->samples;
		jn_sim_stop_at(peer->sim, t);
		while (jn_sim_state(peer->sim)->t < t - 1e-9 * peer->span) {
			JN_TRY(jn_sim_step(peer->sim));
			const JnReport* report = jn_sim_last_report(peer->sim);
			newton += report->newton;
			rejected += report->rejected;
			factorizations += report->factorizations;
			forces += report->forces;
			iterations += report->iterations > 0 ? report->iterations : report->solves;
		}
		const JnState* s = jn_sim_state(peer->sim);
		peer_write(peer, s->t, s->x, s->v);
	}
	peer_pause(peer);
	peer_print("steps", (double)jn_sim_steps(peer->sim));
	peer_print("newton", (double)newton);
	peer_print("rejected", (double)rejected);
	peer_print("seconds", peer->seconds);
	peer_print("forces", (double)forces);
	peer_print("factorizations", (double)factorizations);
	peer_print("iterations", (double)iterations);
	return JN_OK;
}

static double specific_energy(Peer* peer) {
	const JnEnergies e = jn_model_energies(jn_sim_model(peer->sim), &peer->state);
	return (e.kinetic + e.elastic + e.gravity) / jn_sim_mass(peer->sim);
}

static JnStatus energies(Peer* peer) {
	const char* path = peer_word(peer, "states", "");
	FILE* file = fopen(path, "rb");
	if (file == NULL) return perror(path), JN_IO_FAILED;
	peer_print("energy", specific_energy(peer));
	while (fread(&peer->state.t, sizeof(double), 1, file) == 1 &&
		   fread(peer->state.x, sizeof(double), peer->n, file) == peer->n &&
		   fread(peer->state.v, sizeof(double), peer->n, file) == peer->n) {
		jn_state_touch(peer->sys->space, &peer->state);
		peer_print("energy", specific_energy(peer));
	}
	fclose(file);
	return JN_OK;
}

int main(int count, char** arguments) {
	jn_blas_restart(arguments);
	Peer peer;
	const char* verb = count > 1 ? arguments[1] : "";
	JnStatus status = peer_open(&peer, count - 1, arguments + 1);
	if (status != JN_OK)
		;
	else if (strcmp(verb, "run") == 0)
		status = run(&peer);
	else if (strcmp(verb, "energies") == 0)
		status = energies(&peer);
	else if (strcmp(verb, "mesh") == 0)
		status = peer_export(&peer, peer_word(&peer, "out", "model.txt"));
	else
		status = JN_BAD_INPUT, fprintf(stderr, "verbs are run, energies and mesh\n");
	peer_close(&peer);
	return status == JN_OK ? 0 : 1;
}
