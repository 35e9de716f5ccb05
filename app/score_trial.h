/// @file score_trial.h
/// One run of a scene with one method and one step, without recording.
#ifndef JN_APP_SCORE_TRIAL_H
#define JN_APP_SCORE_TRIAL_H

#include "jounce/scene.h"
#include "score.h"

/// A scene being stepped.
typedef struct ScoreSim {
	JnScene* scene;
	JnSim* sim;
} ScoreSim;

/// Build the scene with the method and steps of dt that are never cut, up to `time`. Messages are the library's.
JnStatus score_sim_open(const ScoreOptions* options, const JnIntegratorType* type, double dt, double time,
						ScoreSim* out);
void score_sim_close(ScoreSim* sim);

/// Total energy, and its parts [J].
typedef struct ScoreEnergy {
	double kinetic, potential, total;
} ScoreEnergy;

ScoreEnergy score_energy(JnSim* sim);

/// What a run came to.
typedef struct ScoreTrial {
	bool is_stable;                        ///< all energies within the bound, and the end reached
	double start, end;                     ///< total energy [J]
	double least;                          ///< energy of motion that is but rounding [J]
	double kinetic_range, potential_range; ///< highest - lowest [J]
} ScoreTrial;

/// Run to the end, or until |total - start| > bound [J] (INFINITY: until it is not finite), a step fails, or Ctrl-C.
/// What a failing step says goes to method->failure.
JnStatus score_try(Score* score, ScoreMethod* method, double dt, double bound, ScoreTrial* trial);

#endif
