/// @file wind.h
/// The load of moving air on triangles, its derivatives, and the air itself at one instant. For a triangle with the area
/// vector S = A n and the wind w relative to its centroid,
///   F = 1/2 rho C_d A (w.n) |w.n| n = 1/2 rho C_d (w.S) |w.S| / |S|^2 S,     a third of it at each corner.
#ifndef JN_FORCE_WIND_H
#define JN_FORCE_WIND_H

enum {
	JN_WIND_LANES = 8,  ///< triangles in a block, whatever the width of the processor's vectors
	JN_WIND_WAVES = 64, ///< most waves of the air
};

/// The air at one instant: u(x) = velocity + sum over waves of amplitude sin(wave . x + phase).
typedef struct JnAir {
	double velocity[3]; ///< [m/s]
	int waves;
	double wave[JN_WIND_WAVES][3];      ///< wave vector [rad/m]
	double phase[JN_WIND_WAVES];        ///< in [0, 2 pi] [rad]
	double amplitude[JN_WIND_WAVES][3]; ///< [m/s]
} JnAir;

/// Velocity of the air at `x` [m/s]; gradient[3 * i + j] = d u_i / d x_j [1/s].
void jn_air_at(const JnAir* air, const double x[3], double velocity[3], double gradient[9]);

/// Triangles in blocks of JN_WIND_LANES, the last one padded with triangles of factor 0.
typedef struct JnWindSurface {
	int blocks;
	const int* nodes;     ///< [blocks][3][lanes]: corners, outward by the right-hand rule
	const double* factor; ///< [blocks][lanes]: rho C_d / 6 [kg/m^3], a third of what stands before the law
} JnWindSurface;

/// out[4 * (triangle - first triangle)] .. + 2 = force on each corner of the triangles in first <= block < last [N], then a
/// zero; x and v have three numbers a node. Triangles without area have no force.
typedef void JnWindForces(const JnWindSurface* surface, const JnAir* air, int first, int last, const double* x,
						  const double* v, double* out);

/// The loop for this processor, or for vectors of `width` doubles (8, 4 or 2) when that is not 0; NULL where the processor
/// lacks them. 8 and 4 give the same bits (math/wide.h).
JnWindForces* jn_wind_forces(int width);

/// Derivatives of the force f on each corner, which is the same for the three. Zero for a triangle without area.
typedef struct JnWindTangent {
	double stiffness[3][9]; ///< -df/dp_j of corner j, row-major [N/m]
	double damping[3];      ///< m with -df/dv_j = m m^T for every corner j [(N s/m)^1/2]
} JnWindTangent;

/// From the corners p, the wind w relative to the centroid and the gradient of the air there.
void jn_wind_tangent(double factor, const double* const p[3], const double w[3], const double gradient[9],
					 JnWindTangent* out);

#endif
