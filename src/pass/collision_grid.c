// The links of all threads by the cells of a hashed grid that their middles are in. Inside pass/ only.
#include <math.h>
#include <string.h>

#include "pass/collision.h"

void jn_collision_cell_of(const JnCollision* pass, const double at[3], int cell[3]) {
	for (int a = 0; a < 3; ++a) cell[a] = (int)floor(fmax(-1e9, fmin(1e9, at[a] / pass->cell_width)));
}

static int bucket_of(const JnCollision* pass, const int cell[3]) {
	const uint32_t hash = (uint32_t)cell[0] * 73856093u ^ (uint32_t)cell[1] * 19349663u ^ (uint32_t)cell[2] * 83492791u;
	return (int)(hash & (uint32_t)pass->cell_mask);
}

void jn_collision_fill_grid(JnCollision* pass, double width) {
	pass->cell_width = width;
	memset(pass->cell_head, -1, ((size_t)pass->cell_mask + 1) * sizeof *pass->cell_head);
	for (int link = pass->link_count - 1; link >= 0; --link) {
		double ends[2][3], middle[3];
		jn_collision_link_at(pass, link, ends);
		for (int a = 0; a < 3; ++a) middle[a] = 0.5 * (ends[0][a] + ends[1][a]);
		jn_collision_cell_of(pass, middle, pass->link_cell[link]);
		const int bucket = bucket_of(pass, pass->link_cell[link]);
		pass->cell_next[link] = pass->cell_head[bucket];
		pass->cell_head[bucket] = link;
	}
}

// Several cells share a bucket.
static int skip_others(const JnCollision* pass, int link, const int cell[3]) {
	while (link >= 0 && memcmp(pass->link_cell[link], cell, sizeof pass->link_cell[link]) != 0)
		link = pass->cell_next[link];
	return link;
}

int jn_collision_first_in(const JnCollision* pass, const int cell[3]) {
	return skip_others(pass, pass->cell_head[bucket_of(pass, cell)], cell);
}

int jn_collision_next_in(const JnCollision* pass, int link, const int cell[3]) {
	return skip_others(pass, pass->cell_next[link], cell);
}
