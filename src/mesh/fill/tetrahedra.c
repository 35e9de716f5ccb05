// The surface is remeshed at the size asked for, which keeps edges and all that it shows, with smaller triangles at parts
// that are thin. Should that or Gmsh fail, the zero set of the signed distance is simpler.
#include "mesh/fill/tetrahedra.h"

#include <math.h>
#include <stdio.h>

#include "base/log.h"
#include "mesh/fill/resurface.h"

static const double MOST_CELLS = 2e7;

typedef JnStatus (*Resurface)(const JnSurface*, double, const char*, JnArena*, JnSurface*);

/// Where the messages of a way that may fail are kept.
typedef struct Messages {
	char last_error[512];
} Messages;

static void keep_error(void* user, JnLogLevel level, const char* message) {
	Messages* messages = user;
	if (level == JN_LOG_ERROR) snprintf(messages->last_error, sizeof messages->last_error, "%s", message);
}

/// A way to fill the surface, and the edge of its outer triangles in units of the size.
typedef struct Way {
	Resurface resurface;
	double share;
} Way;

static JnStatus fill(const Way* way, const JnSurface* surface, double size, const char* what, JnArena* arena,
					 JnMesh* mesh) {
	JnArena scratch = {0};
	JnSurface outer;
	JnStatus status = way->resurface(surface, way->share * size, what, &scratch, &outer);
	if (status == JN_OK) status = jn_tetrahedra_inside(&outer, size, what, arena, mesh);
	jn_arena_free(&scratch);
	return status;
}

static JnStatus check_size(const JnSurface* surface, double size, const char* what) {
	const double volume = jn_surface_volume(surface), cells = 6 * sqrt(2) * volume / (size * size * size);
	if (!(volume > 0))
		return jn_error(JN_BAD_INPUT, "%s: the surface has no inside (its volume is %g m^3)", what, volume);
	if (cells <= MOST_CELLS) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s: tetrahedra of %g m in %g m^3 are some %.2g, more than %.0g; ask for larger ones",
					what, size, volume, cells, MOST_CELLS);
}

static const Way ways[] = {{jn_resurface_along, 1}, {jn_resurface_around, 1}, {jn_resurface_around, 0.5}};
enum { WAY_COUNT = sizeof ways / sizeof ways[0] };

JnStatus jn_tetrahedra_fill(const JnSurface* surface, double size, const char* what, JnArena* arena, JnMesh* mesh) {
	JN_TRY(check_size(surface, size, what));
	Messages messages = {0};
	JnStatus status = JN_BAD_INPUT;
	for (int i = 0; i < WAY_COUNT && status == JN_BAD_INPUT; i++) {
		const JnLog log = jn_log_swap((JnLog){keep_error, &messages});
		status = fill(&ways[i], surface, size, what, arena, mesh);
		jn_log_swap(log);
		if (status != JN_OK || i == 0) continue;
		jn_warn(
			"%s: cells of %g m cannot follow the surface: edges were rounded and thin parts left out; smaller cells "
			"may keep them",
			what, size);
	}
	return status == JN_OK ? JN_OK : jn_error(status, "%s", messages.last_error);
}
