/// @file wind.h
/// The wind on the surfaces of a model's bodies (force/wind.h). As in assembly.h, each thread owns a range of nodes: it
/// computes the blocks that touch them and adds in the order of triangles, so that the bits are those of a single thread.
/// Nothing is allocated after creation.
#ifndef JN_MODEL_WIND_H
#define JN_MODEL_WIND_H

#include "model/model.h"
#include "model/wind_gust.h"

struct JnWind {
	const JnModel* model;
	JnGusts gusts;
	JnWindForces* forces; ///< the loop
	int triangles;
	JnWindSurface surface;
	int* low; ///< [blocks]: lowest and highest node of a block
	int* high;
	double typical_force; ///< norm of the forces of the wind's mean speed on the surfaces at rest, all square to it [N]
	JnWindTangent* tangent; ///< one a triangle; NULL when Newton ignores the wind's derivatives
	int* target;            ///< [triangles][3][3]: place in the pattern's full rows of (corner, corner)
	uint64_t stamp;         ///< t and x at which `tangent` was made; 0: not yet
	double* tangent_v;      ///< and v
};

/// The wind on all bodies with drag, in the model's arena. *wind stays NULL when there is none.
JnStatus jn_wind_create(const JnWindDef* def, JnModel* model, JnWind** wind);

/// f += force of the wind at s.
void jn_wind_force(const JnWind* wind, const JnState* s, double* f);

/// Make the derivatives at s; only with `tangent`. True unless those kept are of the same t, x and v.
bool jn_wind_linearize(JnWind* wind, const JnState* s);

/// out += (damping D + stiffness K) in, D = -df/dv and K = -df/dx of the wind's last linearize.
void jn_wind_apply(const JnWind* wind, JnShift shift, const double* in, double* out);

/// Add the same matrix to full[9 * k], the block of place k of the pattern's full rows.
void jn_wind_add_blocks(const JnWind* wind, JnShift shift, double* full);

/// Nodes low <= node < high, those of one thread.
typedef struct JnWindRange {
	int low, high;
} JnWindRange;

/// The nodes of thread `t` of `team`.
JnWindRange jn_wind_range(const JnWind* wind, int t, int team);

bool jn_wind_touches(const JnWind* wind, int block, JnWindRange range);

/// f += vectors[4 * lane] .. + 2 at each corner of the block's triangles that lies in the range.
void jn_wind_scatter(const JnWind* wind, int block, const double* vectors, JnWindRange range, double* f);

#endif
