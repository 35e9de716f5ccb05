/// @file halving.h
/// Sizes dt / 2^level on their own grid: halves are counted, so that a run comes back to a larger size only where a step of
/// that size starts, and to the full one exactly on its grid.
#ifndef JN_CONTROL_HALVING_H
#define JN_CONTROL_HALVING_H

typedef struct JnHalving {
	int level;            ///< halvings at present
	int good;             ///< steps that worked since the last cut
	unsigned long offset; ///< steps of this level done since the grid point of level 0
} JnHalving;

static inline void jn_halving_cut(JnHalving* halving) {
	++halving->level;
	halving->offset *= 2;
	halving->good = 0;
}

/// A step worked: the level falls as far as the grid allows, once `recovery` of them have worked.
static inline void jn_halving_go_on(JnHalving* halving, int recovery) {
	++halving->good;
	++halving->offset;
	while (halving->level > 0 && halving->offset % 2 == 0 && halving->good >= recovery) {
		--halving->level;
		halving->offset /= 2;
	}
	if (halving->level == 0) halving->offset = 0;
}

#endif
