/// @file stage.h
/// Work vectors of the stage solver; they stand behind those of the method in JnIntegrator.vectors.
#ifndef JN_INTEGRATE_STAGE_H
#define JN_INTEGRATE_STAGE_H

/// Number of secant steps that the quasi-Newton update remembers.
enum { JN_STAGE_SECANTS = 12 };

/// Vectors that jn_stage_solve needs: residual, M a, step, last a that served, D step, the latest solutions (0 where
/// entries are held), secant steps.
enum {
	JN_STAGE_RESIDUAL,
	JN_STAGE_MASS,
	JN_STAGE_STEP,
	JN_STAGE_ORIGIN,
	JN_STAGE_DAMPING,
	JN_STAGE_RECENT,
	JN_STAGE_SECANT = JN_STAGE_RECENT + JN_RECENT_COUNT,
	JN_STAGE_VECTORS = JN_STAGE_SECANT + JN_STAGE_SECANTS
};

#endif
