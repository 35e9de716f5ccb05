// A thread on a hand: at 1 kHz the input of a scene follows a device, the scene is stepped on by 1 ms, in as many steps as it
// needs, and the force on the hand goes back. Ticks are paced by the clock; what comes too late is counted.
//
//   cc haptic_thread.c $(pkg-config --cflags --libs jounce) -o haptic_thread && ./haptic_thread scenes/haptic.yaml
#define _GNU_SOURCE // clock_nanosleep
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "jounce/jounce.h"

static const double pi = 3.14159265358979323846;
static const double period = 1e-3; // of the device [s]

// Where the device is after t seconds [m], and how fast [m/s]: read yours here. This one begins softly to draw circles.
static void read_device(double t, double x[3], double v[3]) {
	const double radius = 0.03, rate = 2 * pi, angle = rate * t, swell = 1 - exp(-4 * t), swelling = 4 * exp(-4 * t);
	x[0] = radius * swell * sin(angle);
	x[1] = radius * swell * (1 - cos(angle));
	x[2] = 0;
	v[0] = radius * (swelling * sin(angle) + swell * rate * cos(angle));
	v[1] = radius * (swelling * (1 - cos(angle)) + swell * rate * sin(angle));
	v[2] = 0;
}

// And this is where the force would go [N].
static void drive_device(const double force[3], double* largest) {
	*largest = fmax(*largest, sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]));
}

static double seconds(void) {
	struct timespec now;
	clock_gettime(CLOCK_MONOTONIC, &now);
	return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void sleep_until(double moment) {
	const struct timespec until = {.tv_sec = (time_t)moment, .tv_nsec = (long)(1e9 * (moment - floor(moment)))};
	clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL);
}

typedef struct Tally {
	long ticks, missed;
	double worst, busy, largest; // lateness [s], time computed [s], force [N]
} Tally;

// One tick: step on to time t with the input set for each step, and give the force back.
static JnStatus tick(JnSim* sim, JnInput* hand, double t, Tally* tally) {
	double x[3], v[3], force[3];
	while (jn_sim_state(sim)->t < t - 1e-9) {
		read_device(jn_sim_state(sim)->t + jn_sim_next_dt(sim), x, v);
		jn_input_set(hand, x, v);
		JN_TRY(jn_sim_step(sim));
	}
	JN_TRY(jn_sim_input_force(sim, hand, force));
	drive_device(force, &tally->largest);
	++tally->ticks;
	return JN_OK;
}

static JnStatus run(JnSim* sim, double duration, Tally* tally) {
	JnInput* hand = jn_sim_input(sim, "hand");
	if (hand == NULL) {
		fprintf(stderr, "the scene has no input 'hand': give it drive: [{where: ..., input: hand}]\n");
		return JN_BAD_INPUT;
	}
	const double began = seconds();
	for (double t = period; t <= duration; t = period * (double)(tally->ticks + 1)) {
		const double before = seconds(), due = began + t;
		JN_TRY(tick(sim, hand, t, tally));
		const double now = seconds();
		tally->busy += now - before;
		tally->missed += now > due;
		tally->worst = fmax(tally->worst, now - due);
		if (now < due) sleep_until(due);
	}
	return JN_OK;
}

int main(int count, char** arguments) {
	const char* path = count > 1 ? arguments[1] : "scenes/haptic.yaml";
	const double duration = count > 2 ? atof(arguments[2]) : 5;
	JnScene* scene = NULL;
	JnSim* sim = NULL;
	Tally tally = {0};
	JnStatus status = jn_scene_load(path, 0, NULL, &scene);
	if (status == JN_OK) status = jn_scene_build(scene, 1, &sim);
	if (status == JN_OK) status = run(sim, duration, &tally);
	if (status == JN_OK) {
		printf("%ld ticks of %.1f us, %ld steps; %ld deadlines missed, worst lateness %.3g ms; largest force %.3g N\n",
			   tally.ticks, 1e6 * tally.busy / (double)tally.ticks, jn_sim_steps(sim), tally.missed,
			   1e3 * fmax(tally.worst, 0), tally.largest);
	}
	jn_sim_destroy(sim);
	jn_scene_destroy(scene);
	return status == JN_OK ? 0 : 1;
}
