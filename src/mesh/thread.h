/// @file thread.h
/// A thread as a chain of frames along a curve (EX, "Deformable linear object model"): frame k is the nodes 3 k, 3 k + 1
/// and 3 k + 2 of the mesh, called R, P and Q, and between two frames lie three tetrahedra, a link:
///
///      Q_k ------------- Q_k+1      (R_k+1, P_k, Q_k, R_k), (R_k+1, Q_k+1, Q_k, P_k), (R_k+1, P_k, P_k+1, Q_k+1)
///     / |               / |
///   R_k-|------------ R_k+1|        the axis passes through the point of each frame that `axis` gives
///     \ |               \ |
///      P_k ------------- P_k+1
#ifndef JN_MESH_THREAD_H
#define JN_MESH_THREAD_H

#include <stdbool.h>

enum { JN_THREAD_R, JN_THREAD_P, JN_THREAD_Q, JN_FRAME_NODES, JN_LINK_CELLS = 3 };

typedef struct JnThread {
	int frame_count;    ///< >= 2
	bool is_closed;     ///< a link joins the last frame to the first
	double radius;      ///< of the thread as it is seen and as it collides [m]
	double link_length; ///< of each link along the curve, at rest [m]
	double axis[3];     ///< weights of R, P and Q whose sum is 1: the point of a frame that lies on the axis
} JnThread;

/// Links: pairs of neighbouring frames.
static inline int jn_thread_links(const JnThread* thread) {
	return thread->frame_count - !thread->is_closed;
}

/// The frame at the end of a link, which begins at frame `link`.
static inline int jn_thread_end(const JnThread* thread, int link) {
	return link + 1 < thread->frame_count ? link + 1 : 0;
}

#endif
