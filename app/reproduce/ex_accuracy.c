#include "reproduce/ex_accuracy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"
#include "score_trial.h"

static const double reference_share = 1.0 / 40; // of symplectic Euler's limit: RK4's errors are 1e-6 of those compared
static const double order_share = 1.0 / 4;      // of a method's own limit, and half of it

/// Positions at the end of a run, or NULL.
typedef struct Ends {
	size_t length;
	double *reference, *here; // 3 * nodes [m]
} Ends;

static void say_nothing(void* user, JnLogLevel level, const char* message) {
	(void)user;
	(void)level;
	(void)message;
}

static void keep_end(JnSim* sim, Ends* ends, double** to) {
	ends->length = jn_sim_system(sim)->space->length;
	if (*to == NULL) *to = malloc(ends->length * sizeof **to);
	if (*to != NULL) memcpy(*to, jn_sim_state(sim)->x, ends->length * sizeof **to);
}

// *works: it came to the end with finite positions.
static JnStatus run_to_end(Score* score, const JnIntegratorType* type, double dt, double time, Ends* ends, double** to,
						   bool* works) {
	ScoreSim run;
	*works = false;
	score_show(score, "accuracy of %s: step %.3g s", type->row.name, dt);
	JN_TRY(score_sim_open(score->options, type, time / ceil(time / dt), time, &run));
	const JnLog before = jn_log_swap((JnLog){say_nothing, NULL});
	JnStatus status = JN_OK;
	while (status == JN_OK && !jn_sim_is_done(run.sim) && !score_is_stopped(score)) status = jn_sim_step(run.sim);
	jn_log_swap(before);
	keep_end(run.sim, ends, to);
	*works = status == JN_OK && jn_sim_is_done(run.sim);
	score_sim_close(&run);
	return status == JN_RUN_FAILED ? JN_OK : status;
}

static double rms(const Ends* ends) {
	double sum = 0;
	for (size_t k = 0; k < ends->length; ++k) sum += pow(ends->here[k] - ends->reference[k], 2);
	return sqrt(3 * sum / (double)ends->length);
}

static JnStatus find_error(Score* score, const ScoreMethod* method, double dt, double time, Ends* ends, double* error) {
	bool works;
	*error = NAN;
	if (!(dt <= method->limit)) return JN_OK;
	JN_TRY(run_to_end(score, method->type, dt, time, ends, &ends->here, &works));
	if (works && ends->here != NULL) *error = rms(ends);
	return JN_OK;
}

static JnStatus find_method(Score* score, const ScoreMethod* method, double rate, double time, Ends* ends,
							ExAccuracy* out) {
	double coarse, fine;
	out->dt = rate * method->seconds;
	JN_TRY(find_error(score, method, out->dt, time, ends, &out->error));
	JN_TRY(find_error(score, method, order_share * method->limit, time, ends, &coarse));
	JN_TRY(find_error(score, method, 0.5 * order_share * method->limit, time, ends, &fine));
	out->order = log2(coarse / fine);
	return JN_OK;
}

static JnStatus find_all(Score* score, const ScoreMethod* euler, double share, double time, Ends* ends,
						 ExAccuracy* out) {
	bool works;
	const double rate = share * euler->limit / euler->seconds;
	JN_TRY(run_to_end(score, score->reference, reference_share * euler->limit, time, ends, &ends->reference, &works));
	if (!works || ends->reference == NULL) return JN_OK;
	for (int i = 0; i < score->count && !score_is_stopped(score); ++i)
		JN_TRY(find_method(score, &score->list[i], rate, time, ends, &out[i]));
	return JN_OK;
}

JnStatus ex_accuracy_find(Score* score, double share, double time, ExAccuracy* out) {
	Ends ends = {0};
	const ScoreMethod* euler = score_find(score, "symplectic_euler");
	for (int i = 0; i < score->count; ++i) out[i] = (ExAccuracy){NAN, NAN, NAN};
	if (euler == NULL || !(euler->limit > 0) || !(euler->seconds > 0)) return JN_OK;
	const JnStatus status = find_all(score, euler, share, time, &ends, out);
	free(ends.reference);
	free(ends.here);
	return status;
}
