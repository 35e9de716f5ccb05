/// @file collision.h
/// The collision pass: what it keeps, and the parts of a correction. Inside pass/ only. A thread is a chain of links, capsules
/// about its axis; they meet each other, obstacles, and the surfaces of bodies.
///
///   watch     which pairs may meet as long as no point moves farther than a reach     collision_watch.c
///   find      where those that are near touch between start and end: a block each     collision_find.c
///   solve     projected Gauss-Seidel, positions first and velocities then             impulses.c, collision.c
#ifndef JN_PASS_COLLISION_H
#define JN_PASS_COLLISION_H

#include "detect/skin.h"
#include "model/system.h"
#include "pass/friction.h"
#include "pass/impulses.h"
#include "pass/pass.h"

/// A thread as a chain of frames and links, numbered on from those of the threads before it.
typedef struct JnStrand {
	int body;
	int first_frame, frame_count;
	int first_link, link_count;
	bool is_closed;
	double radius;  ///< [m]
	double axis[3]; ///< weights of a frame's nodes
	double length;  ///< mean length of a link at rest [m]
	int apart;      ///< links whose numbers differ by less do not collide
} JnStrand;

/// The surface of a body that is no thread, and what is known of its edges.
typedef struct JnHide {
	JnSkin skin;
	int body;
	int first_vertex; ///< of the vertices of all hides
	int edge_count;
	int (*edges)[4]; ///< vertices of its ends, triangles on its sides, or -1
} JnHide;

typedef enum JnMeetingKind {
	JN_MEETING_LINKS,
	JN_MEETING_FRAME_OBSTACLE,
	JN_MEETING_LINK_OBSTACLE,
	JN_MEETING_FRAME_TRIANGLE,
	JN_MEETING_LINK_EDGE,
	JN_MEETING_SITE, ///< of a suture: never watched
} JnMeetingKind;

/// A pair to watch: numbers of a link or frame, and of what it may meet.
typedef struct JnWatch {
	JnMeetingKind kind;
	int first, second;
	int hide;     ///< whose triangle or edge `second` is
	double clear; ///< they meet only once they have moved by more than this together [m]; 0: not known
} JnWatch;

/// Lengths of the shortest thread that something may move in a step: nothing is found there but what explodes.
enum { JN_COLLISION_TOO_FAR = 100 };

/// Who else has blocks solved with those of collisions, and says which links pass through a body.
typedef struct JnCollisionGuest {
	void* user; ///< NULL: nobody
	JnStatus (*collect)(void* user, const JnStep* step, JnImpulses* out);
	bool (*passes)(void* user, int link, int body); ///< links do not collide with that body for which this is true
} JnCollisionGuest;

typedef struct JnCollisionTally {
	int sites, pressing, sweeps; ///< blocks, those with an impulse, sweeps at both levels
	double overlap;              ///< largest that is left [m]
	double impulse;              ///< sum of the sizes of normal impulses [N s]
	double work;                 ///< of impulses, over the mean relative velocities of the step [J]
} JnCollisionTally;

typedef struct JnCollision {
	JnPass base;
	const JnCollisionDef* def;
	JnModel* model;
	JnModelSystem* sys;
	JnArena arena;
	int strand_count, frame_count, link_count;
	JnStrand* strands;
	int* frame_node;     ///< first node of each frame
	int* frame_strand;   ///< its thread
	int (*link_ends)[2]; ///< frames of each link
	int* link_strand;
	int hide_count, vertex_count;
	JnHide* hides;
	JnFriction friction;
	int *strand_surface, *hide_surface, *obstacle_surface; ///< which row and column of it
	double largest_radius;                                 ///< [m]
	double margin;                     ///< pairs this much farther apart than they touch have blocks [m]
	double* inverse_mass;              ///< 3 * nodes; 0 where held [1/kg]
	double (*start)[3], (*end)[3];     ///< frames' points on the axis, then the hides' vertices, in the step [m]
	double (*moved)[3];                ///< at the end, once impulses have acted [m]
	uint64_t start_stamp, moved_stamp; ///< of the states whose points `start` and `moved` are; 0: none
	double (*watched)[3];              ///< the same when the pairs were chosen
	double reach;                      ///< how far they may be from there [m]
	bool is_watching;
	int watch_count;
	JnWatch* watches;
	size_t watch_capacity;
	int cell_mask, *cell_head, *cell_next; ///< hashed grid of links
	int (*link_cell)[3];
	double cell_width;      ///< [m]
	double* frame_distance; ///< work space: of the frames from an obstacle [m]
	double* travelled;      ///< farthest that a frame is in the step from where it was watched [m]
	JnCollisionGuest guest;
	JnImpulses now, kept; ///< of the attempt, and of the last accepted step
	JnImpulses seen;      ///< of the attempt, before it was looked at again
	bool is_loaded;       ///< `load` acts in the prediction
	double* load;         ///< 3 * nodes: residue of the last step's impulses [N]
	bool has_failed;
	double ran_away;              ///< by which a point moves in the attempt, when that is absurd [m]; 0: it is not
	double extent;                ///< of the shortest thread along its axis [m]
	double missed;                ///< overlap that sweeps have left in the attempt [m]
	int missed_at;                ///< a node there
	JnCollisionTally tally, last; ///< of the attempt, and of the last accepted step; work summed up
	double total_work;
} JnCollision;

/// Place of a hide's vertex among the points.
static inline int jn_collision_vertex(const JnCollision* pass, int hide, int vertex) {
	return pass->frame_count + pass->hides[hide].first_vertex + vertex;
}

JnStatus jn_collision_create(const void* options, JnModel* model, JnPass** out);
void jn_collision_destroy(JnPass* pass);

/// Where frames' points on the axis are, and the hides' vertices behind them.
void jn_collision_points(const JnCollision* pass, const double* x, double (*out)[3]);

/// Largest square of the distance between points of two lists [m^2].
double jn_collision_farthest(int count, double (*a)[3], double (*b)[3]);

/// Positions of frames and vertices at the start and the end, and pairs that can meet on the way.
JnStatus jn_collision_watch(JnCollision* pass, const JnStep* step);

/// Parts of it: remember a pair, where a link was when pairs were chosen, and pairs with surfaces; links are at most `length` long.
JnStatus jn_collision_add_watch(JnCollision* pass, JnWatch watch);
void jn_collision_link_at(const JnCollision* pass, int link, double out[2][3]);
JnStatus jn_collision_watch_hides(JnCollision* pass, double length);

/// A hashed grid of links by their middles, of cells of a width [m]; the links in a cell, -1 at the end.
void jn_collision_fill_grid(JnCollision* pass, double width);
void jn_collision_cell_of(const JnCollision* pass, const double at[3], int cell[3]);
int jn_collision_first_in(const JnCollision* pass, const int cell[3]);
int jn_collision_next_in(const JnCollision* pass, int link, const int cell[3]);

/// Blocks of all pairs that touch, or nearly, into pass->now.
JnStatus jn_collision_find(JnCollision* pass, const JnStep* step);

/// Where a point is at a share of the step, on its straight path; and a segment between two.
void jn_collision_at(const JnCollision* pass, int point, double when, double out[3]);
void jn_collision_segment_at(const JnCollision* pass, const int ends[2], double when, double out[2][3]);

/// Two segments, or a point and a triangle: numbers of points.
typedef struct JnCollisionPair {
	int first[2], second[3];
	int first_count, second_count;
} JnCollisionPair;

/// Where they are nearest.
typedef struct JnNearest {
	double distance;   ///< [m]
	double before;     ///< at the start of the step [m]
	double offset[3];  ///< from the second to the first [m]
	double share;      ///< of the first, from its first point on
	double weights[3]; ///< of the second's points
} JnNearest;

void jn_collision_nearest(const JnCollision* pass, const JnCollisionPair* pair, double when, JnNearest* out);

/// Whether the pair comes within `touch` plus the margin; `out` is then where it is nearest, as late as sides are certain,
/// at a share `when` of the step.
bool jn_collision_advance(const JnCollision* pass, const JnCollisionPair* pair, double touch, double* when,
						  JnNearest* out);
/// Where the nearest points of the two are at the end of the step.
void jn_collision_first_at_end(const JnCollision* pass, const JnCollisionPair* pair, const JnNearest* near,
							   double out[3]);
void jn_collision_second_at_end(const JnCollision* pass, const JnCollisionPair* pair, const JnNearest* near,
								double out[3]);

/// Entries of a point at `share` of a link, times `sign`; `offset` leads from the axis to where the surfaces touch [m], and
/// moves with the link; NULL: none.
void jn_collision_link_entries(const JnCollision* pass, int link, double share, double sign, const double offset[3],
							   const double* x, JnBlockEntry entries[6]);

/// What every block asks for once its entries and normal are known: that its points be `touch` apart [m], that they have
/// not slid since the start of the step, and velocities that part. What overlaps at the start, `gap` < 0 [m], is pushed out
/// no faster than the definition says.
void jn_collision_set_targets(JnCollision* pass, const JnStep* step, double touch, double gap, double friction,
							  JnBlock* block);

/// How many there may be of what a name tells apart: frames, edges of a surface, obstacles; and surfaces.
enum { JN_NAMED_MOST = 0xffffff, JN_NAMED_HIDES = 0x1000 };

uint64_t jn_collision_name(JnMeetingKind kind, int hide, int first, int second);

/// Whether p and q are not much farther apart along the normal than `touch`.
bool jn_collision_is_near(const JnCollision* pass, const double n[3], const double p[3], const double q[3],
						  double touch);

/// The link that begins at a frame, or ends there when none does; the frame is at `share` of it, 0 or 1.
int jn_collision_link_of_frame(const JnCollision* pass, int frame, double* share);

/// The surfaces of bodies that are no threads. JN_BAD_INPUT after a message for those that threads cannot meet.
JnStatus jn_collision_hides_create(JnCollision* pass);

/// A frame and a triangle that are watched, and the unit normal of the triangle.
JnCollisionPair jn_collision_triangle_pair(const JnCollision* pass, const JnWatch* watch);
void jn_collision_normal(const JnCollision* pass, const JnCollisionPair* pair, double when, double normal[3]);

/// mu of a thread on a surface.
static inline double jn_collision_hide_friction(const JnCollision* pass, int strand, int hide) {
	return jn_friction_of(&pass->friction, pass->strand_surface[strand], pass->hide_surface[hide]);
}

/// Blocks of a frame with the `count` triangles of one surface that are watched, and of a link with an edge.
JnStatus jn_collision_frame_on_surface(JnCollision* pass, const JnStep* step, int count, const JnWatch* watches);
JnStatus jn_collision_link_on_edge(JnCollision* pass, const JnStep* step, const JnWatch* watch);

/// Blocks of a watched pair with an obstacle.
JnStatus jn_collision_frame_on_obstacle(JnCollision* pass, const JnStep* step, const JnWatch* watch);
JnStatus jn_collision_link_on_obstacle(JnCollision* pass, const JnStep* step, const JnWatch* watch);

#endif
