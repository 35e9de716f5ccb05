// Trees of points with the lowest one as root (union-find with halved paths): the result depends on no order.
#include "pass/fragments.h"

JnStatus jn_fragments_create(int point_count, JnArena* arena, JnFragments* fragments) {
	*fragments = (JnFragments){.point_count = point_count};
	JN_NEW(arena, fragments->parent, point_count);
	JN_NEW(arena, fragments->size, point_count);
	JN_NEW(arena, fragments->number, point_count);
	return JN_OK;
}

void jn_fragments_begin(JnFragments* fragments) {
	for (int i = 0; i < fragments->point_count; ++i) fragments->parent[i] = i;
}

static int root_of(int* parent, int point) {
	while (parent[point] != point) {
		parent[point] = parent[parent[point]];
		point = parent[point];
	}
	return point;
}

static void join(int* parent, int a, int b) {
	const int first = root_of(parent, a), second = root_of(parent, b);
	if (first < second) parent[second] = first;
	if (second < first) parent[first] = second;
}

void jn_fragments_join(JnFragments* fragments, const JnGroup* group, const bool* is_broken) {
	for (int e = 0; e < group->count; ++e)
		for (int i = 1; i < group->kernel->nodes && !is_broken[e]; ++i)
			join(fragments->parent, jn_group_node(group, e, 0), jn_group_node(group, e, i));
}

void jn_fragments_count(JnFragments* fragments, const bool* is_member) {
	int next = 0;
	fragments->count = fragments->loose_count = fragments->largest = 0;
	for (int i = 0; i < fragments->point_count; ++i) fragments->size[i] = 0;
	for (int i = 0; i < fragments->point_count; ++i) {
		const int root = root_of(fragments->parent, i); // the lowest point of its piece: numbered before the others
		if (is_member[i] && root == i) fragments->number[i] = next++;
		if (is_member[i]) ++fragments->size[root];
		fragments->number[i] = is_member[i] ? fragments->number[root] : -1;
	}
	for (int i = 0; i < fragments->point_count; ++i) {
		fragments->count += fragments->size[i] > 1;
		fragments->loose_count += fragments->size[i] == 1;
		if (fragments->size[i] > fragments->largest) fragments->largest = fragments->size[i];
	}
}
