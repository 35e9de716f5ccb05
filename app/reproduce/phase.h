/// @file phase.h
/// Phase portraits of a pendulum: points of runs in the plane of angle and angular speed, over exact curves of equal energy.
#ifndef JN_APP_REPRODUCE_PHASE_H
#define JN_APP_REPRODUCE_PHASE_H

#include "base/arena.h"
#include "jounce/base.h"

enum { PHASE_MOST_PANELS = 15, PHASE_MOST_RUNS = 5 };

/// The portrait of a method: one run from each start.
typedef struct PhasePanel {
	const char* title;
	int run_count;
	const char* runs[PHASE_MOST_RUNS]; ///< CSV files with the columns below, relative to the picture's folder
	int theta, omega;                  ///< columns, from 0
} PhasePanel;

typedef struct PhasePicture {
	const char* name; ///< of the files: name.gnuplot, name.png
	const char* title;
	int columns;       ///< panels side by side
	double omega_high; ///< of the axis of speeds [rad/s]
	int count;
	PhasePanel panels[PHASE_MOST_PANELS];
} PhasePicture;

/// Write `name`: curves of equal energy of the pendulum with g/l = `stiffness` [1/s^2] through (angle, 0), one block each,
/// then the separatrix, then one curve that turns over. JN_IO_FAILED.
JnStatus phase_curves_write(const char* folder, const char* name, double stiffness, int count, const double* angles);

/// Write the script, which finds the curves in `curves`, and draw. JN_IO_FAILED.
JnStatus phase_draw(const PhasePicture* picture, const char* folder, const char* curves, int curve_count);

#endif
