/// @file watch.h
/// The watch over the energy of a run. With E = kinetic + elastic + gravity and W the work that driven nodes, inputs and wind
/// have done so far, nothing but an error of the integration lets
///   gain = (E - W) - (the lowest E - W so far)
/// grow: damping, friction and cracks take energy away. It is compared with the largest kinetic + elastic energy so far, or with
/// the work that went in and out, if that is more.
#ifndef JN_SIM_WATCH_H
#define JN_SIM_WATCH_H

#include "jounce/sim.h"
#include "model/model.h"

enum { JN_WATCH_FORCE, JN_WATCH_FORCE_BEFORE, JN_WATCH_WIND, JN_WATCH_WIND_BEFORE, JN_WATCH_WORK, JN_WATCH_VECTORS };

typedef struct JnEnergyWatch {
	bool has_begun, has_warned;
	bool has_forces;                 ///< those of the state looked at last
	double lowest;                   ///< of E - W [J]
	double largest;                  ///< of kinetic + elastic, as long as the gain was small [J]
	double floor;                    ///< kinetic + elastic energies below this tell nothing [J]
	double work;                     ///< W [J]
	double passed;                   ///< work that went in or out, which is known to a share of it [J]
	double t;                        ///< of the state looked at last [s]
	double gain;                     ///< [J]
	JnVec vectors[JN_WATCH_VECTORS]; ///< NULL: nothing does work on the model
} JnEnergyWatch;

extern const JnKey jn_watch_keys[]; ///< of JnWatchDef

/// Vectors for a simulation whose system stands. Free with jn_watch_destroy.
JnStatus jn_watch_create(JnSim* sim);
void jn_watch_destroy(JnSim* sim);

/// Save what is remembered, or read it.
void jn_watch_archive(JnSim* sim, JnArchive* archive);

#endif
