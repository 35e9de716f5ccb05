/// @file suture.h
/// The suture pass: where a thread goes through the surface of a body. Inside pass/ only. A site is a point of a triangle of
/// the surface, through which the thread passes at a coordinate s, in links from its tip on. Across the thread the two are
/// held together, along it they rub; the blocks are solved with those of collisions.
#ifndef JN_PASS_SUTURE_H
#define JN_PASS_SUTURE_H

#include "pass/collision.h"

enum { JN_SITES_MOST = 256 };

typedef struct JnSite {
	int number;        ///< they are counted as they come
	int nodes[3];      ///< of the triangle
	double weights[3]; ///< of these
	double s;          ///< where the thread passes: links from its tip on
} JnSite;

typedef struct JnSuture {
	JnPass base;
	const JnSutureDef* def;
	JnModel* model;
	JnArena arena;
	JnCollision* collision;
	int strand, hide;   ///< of the collision pass
	double clear;       ///< links this near to a site do not collide, counted in links
	int count, made;    ///< sites there are, and have been
	JnSite* sites;      ///< the newest last: the thread passes them from its tip on in the opposite order
	double* tried;      ///< s of each, in the attempt
	bool is_tip_inside; ///< of the body
	double error;       ///< largest distance of a site from the axis [m]
} JnSuture;

/// A frame of the thread, counted from the tip on.
int jn_suture_frame(const JnSuture* pass, int index);

/// Move s to where the thread is nearest to the site, from where it was. Returns the distance [m]; *beyond: by how many
/// links the nearest point would lie beyond the thread's end (> 0) or before its tip (< 0), 0 else.
double jn_suture_slide(const JnSuture* pass, const JnSite* site, const double* x, double* s, double* beyond);

/// Whether the tip lies within the body at rest.
bool jn_suture_begins_inside(const JnSuture* pass);

/// Look for places where the tip has gone through the surface in an accepted step.
void jn_suture_puncture(JnSuture* pass, const JnStep* step);

#endif
