// Contacts of a step. The first look follows bodies to the predicted end. A correction moves them elsewhere, along other
// straight lines, on which they may meet what the prediction has missed: further looks follow them to the corrected end,
// and what is met there and not among the rows yet joins them. A row whose plane stands badly for the surface is renewed.
#include <math.h>

#include "base/grow.h"
#include "base/timer.h"
#include "math/vec3.h"
#include "mesh/triangle_tree.h"
#include "pass/contact.h"

static const double slack = 1e-3; // of the margin: deeper overlaps at the end are contacts that were missed
static const double bend = 0.5;   // of the margin: where the planes that stand for surfaces have become wrong by more
static const double same = 0.9;   // cosine of normals of one contact, seen twice

static JnStatus reserve(JnContactSet* set, int count) {
	return jn_grow((void**)&set->at, &set->capacity, (size_t)count, sizeof *set->at);
}

static JnStatus look(JnContactPass* pass, const JnStep* step, const double* x, JnContactList* list) {
	const double began = jn_seconds();
	const JnStatus status = jn_detector_find(pass->detector, step->start->x, x, pass->margin, list);
	pass->sys->base.report->seconds_detect += jn_seconds() - began;
	return status;
}

JnStatus jn_contact_find(JnContactPass* pass, const JnStep* step, int64_t* pairs) {
	JnContactSet* found = &pass->found;
	JnContactList list;
	JN_TRY(look(pass, step, step->end->x, &list));
	JN_TRY(reserve(found, list.count));
	for (int i = 0; i < list.count; ++i) found->at[i] = list.contacts[i];
	found->count = list.count;
	*pairs = list.counts.pairs;
	JN_TRY(jn_contact_rows_fill(pass, found, step, &pass->now));
	jn_contact_rows_warm(&pass->now, &pass->kept);
	return JN_OK;
}

// The contact among those from `first` on, which are in the same order, that is this one seen again; or NULL.
static JnContact* find_same(const JnContactSet* found, int first, const JnContact* contact) {
	for (int i = first; i < found->count && jn_contact_order(&found->at[i], contact) == 0; ++i) {
		const bool is_there = contact->other_skin == JN_OBSTACLE_SKIN || found->at[i].other == contact->other;
		if (is_there && vec3_dot(found->at[i].normal, contact->normal) > same) return &found->at[i];
	}
	return NULL;
}

// Move the new contacts, which stand behind the `known` ones, to their places, behind those of the same vertex.
static void sort(JnContactSet* found, int known) {
	for (int i = known; i < found->count; ++i) {
		const JnContact contact = found->at[i];
		int place = i;
		for (; place > 0 && jn_contact_order(&found->at[place - 1], &contact) > 0; --place)
			found->at[place] = found->at[place - 1];
		found->at[place] = contact;
	}
}

// normal . (vertex - point of the triangle) where the nodes are at x.
static double gap_at(const JnContactPass* pass, const JnContact* contact, const double* x) {
	const JnSkin* other = &pass->skins[contact->other_skin];
	double apart[3], corner[3];
	jn_skin_position(&pass->skins[contact->vertex_skin], contact->vertex, x, apart);
	for (int i = 0; i < 3; ++i) {
		jn_skin_position(other, other->triangles[3 * (ptrdiff_t)contact->other + i], x, corner);
		for (int a = 0; a < 3; ++a) apart[a] -= contact->weights[i] * corner[a];
	}
	return vec3_dot(contact->normal, apart);
}

// The same contact with the normal and the nearest point that its triangle has at the end. False where it has no area.
static bool turn(const JnContactPass* pass, const JnStep* step, const double* x, JnContact* contact) {
	const JnSkin* other = &pass->skins[contact->other_skin];
	const int* t = other->triangles + 3 * (ptrdiff_t)contact->other;
	double at[3][3], p[3], normal[3];
	for (int i = 0; i < 3; ++i) jn_skin_position(other, t[i], x, at[i]);
	jn_skin_position(&pass->skins[contact->vertex_skin], contact->vertex, x, p);
	vec3_triangle(at[0], at[1], at[2], normal);
	vec3_normalize(normal);
	const double side = vec3_dot(normal, contact->normal) < 0 ? -1 : 1; // a sheet without inside has two
	jn_triangle_nearest(at[0], at[1], at[2], p, contact->weights);
	for (int a = 0; a < 3; ++a) contact->normal[a] = side * normal[a];
	contact->gap = gap_at(pass, contact, step->start->x);
	contact->gap_end = gap_at(pass, contact, x);
	contact->when = 1;
	return vec3_dot(normal, normal) > 0;
}

// Triangles turn while they are pressed: renew the rows that no longer stand for theirs. Returns how many.
static int renew(JnContactPass* pass, const JnStep* step, const double* x, double* depth) {
	int renewed = 0;
	for (int i = 0; i < pass->now.count; ++i) {
		JnContact contact = pass->now.contact[i];
		if (contact.other_skin == JN_OBSTACLE_SKIN || !(pass->now.lambda[i][0] > 0)) continue;
		const double allowed = fmin(0, contact.gap) - bend * pass->margin;
		if (!turn(pass, step, x, &contact) || contact.gap_end >= allowed) continue;
		pass->found.at[pass->now.source[i]] = contact;
		++renewed;
		if (contact.gap_end > -*depth) continue;
		*depth = -contact.gap_end;
		pass->worst = contact;
	}
	return renewed;
}

JnStatus jn_contact_look_again(JnContactPass* pass, const JnStep* step, const double* x, int* missed, double* depth) {
	JnContactSet* found = &pass->found;
	const int known = found->count;
	JnContactList list;
	*missed = 0;
	*depth = 0;
	JN_TRY(look(pass, step, x, &list));
	JN_TRY(reserve(found, known + list.count));
	int renewed = renew(pass, step, x, depth);
	for (int i = 0, first = 0; i < list.count; ++i) {
		const JnContact* contact = &list.contacts[i];
		const double allowed = fmin(0, contact->gap); // what overlaps at the start is pushed out in its time
		if (contact->gap_end >= allowed - slack * pass->margin) continue;
		const JnContactSet before = {.at = found->at, .count = known};
		while (first < known && jn_contact_order(&found->at[first], contact) < 0) ++first;
		JnContact* twin = find_same(&before, first, contact);
		if (twin != NULL && contact->gap_end >= allowed - bend * pass->margin) continue;
		if (twin == NULL)
			found->at[known + (*missed)++] = *contact;
		else
			*twin = *contact, ++renewed;
		if (contact->gap_end > -*depth) continue;
		*depth = -contact->gap_end;
		pass->worst = *contact;
	}
	found->count = known + *missed;
	sort(found, known);
	*missed += renewed;
	return JN_OK;
}

JnStatus jn_contact_extend(JnContactPass* pass, const JnStep* step) {
	const JnContactRows rows = pass->last;
	pass->last = pass->now;
	pass->now = rows;
	JN_TRY(jn_contact_rows_fill(pass, &pass->found, step, &pass->now));
	jn_contact_rows_warm(&pass->now, &pass->last);
	return JN_OK;
}
