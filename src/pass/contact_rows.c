// From contacts to rows of G. The correction x = xp + theta dt (v - vp) moves a contact over the step by
//
//   s = G (xp - x0) + theta dt G (v - vp)
//
// The rule `approaching` asks for s_n >= -gap, so that surfaces meet at the end of the step and do not overlap, and
// friction acts against s_t, so that what sticks does not creep: with w = s / (theta dt),
//
//   G v >= G vp - (gap + G (xp - x0)) / (theta dt),    the same for s_t = 0
//
// which is G v >= -gap / dt for Backward Euler, where xp = x0 + dt vp and theta is 1. The rule `touching` is that of the
// paper: G v >= 0 for what touches at the start. What overlaps is separated, but not faster than at `push_out`.
#include <math.h>
#include <string.h>

#include "base/grow.h"
#include "math/vec3.h"
#include "pass/contact.h"

typedef struct Row {
	int count;
	int* node;
	double* weight;
} Row;

static void add_node(Row* row, int node, double weight) {
	for (int i = 0; i < row->count; ++i)
		if (row->node[i] == node) {
			row->weight[i] += weight;
			return;
		}
	row->node[row->count] = node;
	row->weight[row->count++] = weight;
}

static void add_vertex(const JnSkin* skin, int vertex, double weight, Row* row) {
	for (int i = 0; i < skin->carriers; ++i) {
		const ptrdiff_t k = (ptrdiff_t)skin->carriers * vertex + i;
		add_node(row, skin->nodes[k], weight * (skin->weights != NULL ? skin->weights[k] : 1));
	}
}

static void add_contact(const JnContactPass* pass, const JnContact* contact, Row* row) {
	add_vertex(&pass->skins[contact->vertex_skin], contact->vertex, 1, row);
	if (contact->other_skin == JN_OBSTACLE_SKIN) return;
	const JnSkin* other = &pass->skins[contact->other_skin];
	for (int i = 0; i < 3; ++i)
		add_vertex(other, other->triangles[3 * (ptrdiff_t)contact->other + i], -contact->weights[i], row);
}

// Two directions across the normal, the same for the same normal.
static void fill_frame(const double normal[3], double frame[9]) {
	int least = 0;
	for (int a = 1; a < 3; ++a)
		if (fabs(normal[a]) < fabs(normal[least])) least = a;
	double axis[3] = {0};
	axis[least] = 1;
	memcpy(frame, normal, 3 * sizeof *frame);
	vec3_cross(normal, axis, frame + 3);
	vec3_normalize(frame + 3);
	vec3_cross(normal, frame + 3, frame + 6);
}

// Relative displacement over the predicted step and relative velocity at its end, in the frame.
static void measure_motion(const JnContactRows* rows, int i, const JnStep* step, double moved[3], double v[3]) {
	double x[3] = {0}, u[3] = {0};
	for (int k = rows->start[i]; k < rows->start[i + 1]; ++k)
		for (size_t a = 0; a < 3; ++a) {
			const size_t entry = 3 * (size_t)rows->node[k] + a;
			x[a] += rows->weight[k] * (step->end->x[entry] - step->start->x[entry]);
			u[a] += rows->weight[k] * step->end->v[entry];
		}
	for (int r = 0; r < 3; ++r) {
		moved[r] = vec3_dot(rows->frame[i] + 3 * (ptrdiff_t)r, x);
		v[r] = vec3_dot(rows->frame[i] + 3 * (ptrdiff_t)r, u);
	}
}

static void fill_bound(const JnContactPass* pass, const JnStep* step, JnContactRows* rows, int i) {
	// What is met at the end alone lay beside the surface at the start, where its gap says nothing: that is no overlap.
	const double fastest = rows->contact[i].when < 1 ? pass->def->push_out * step->dt : INFINITY;
	const double closing = fmin(-rows->gap[i], fastest);
	double moved[3], v[3];
	measure_motion(rows, i, step, moved, v);
	for (int r = 0; r < 3; ++r) {
		const double wanted = r == 0 ? closing : 0;
		rows->bound[i][r] = pass->def->rule == JN_RULE_TOUCHING ? fmax(0, wanted / step->dt)
																: v[r] + (wanted - moved[r]) / (pass->theta * step->dt);
	}
}

static double friction_of(const JnContactPass* pass, const JnContact* contact) {
	const int mine = pass->skin_surface[contact->vertex_skin];
	const int other = contact->other_skin == JN_OBSTACLE_SKIN ? pass->obstacle_surface[contact->other]
															  : pass->skin_surface[contact->other_skin];
	return jn_friction_of(&pass->friction, mine, other);
}

static int most_entries(const JnContactPass* pass, const JnContact* contact) {
	const int own = pass->skins[contact->vertex_skin].carriers;
	return contact->other_skin == JN_OBSTACLE_SKIN ? own : own + 3 * pass->skins[contact->other_skin].carriers;
}

// Can an impulse along the normal move anything?
static bool is_movable(const JnContactPass* pass, const Row* row, const double normal[3]) {
	for (int i = 0; i < row->count; ++i)
		for (int a = 0; a < 3; ++a)
			if (row->weight[i] * normal[a] != 0 && !pass->model->held[3 * row->node[i] + a]) return true;
	return false;
}

// The paper knows only what touches already.
static bool is_wanted(const JnContactPass* pass, const JnContact* contact) {
	return pass->def->rule != JN_RULE_TOUCHING || (contact->when < 1 && contact->gap <= pass->margin);
}

JnStatus jn_contact_rows_fill(JnContactPass* pass, const JnContactSet* found, const JnStep* step, JnContactRows* rows) {
	int entries = 0;
	for (int i = 0; i < found->count; ++i) entries += most_entries(pass, &found->at[i]);
	JN_TRY(jn_contact_rows_reserve(rows, found->count, entries));
	rows->start[0] = 0;
	for (int c = 0; c < found->count; ++c) {
		const JnContact* contact = &found->at[c];
		if (!is_wanted(pass, contact)) continue;
		const int i = rows->count, first = rows->start[i];
		Row row = {.node = rows->node + first, .weight = rows->weight + first};
		add_contact(pass, contact, &row);
		if (!is_movable(pass, &row, contact->normal)) continue;
		++rows->count;
		rows->start[i + 1] = first + row.count;
		rows->contact[i] = *contact;
		rows->source[i] = c;
		rows->gap[i] = contact->gap;
		rows->friction[i] = friction_of(pass, contact);
		fill_frame(contact->normal, rows->frame[i]);
		fill_bound(pass, step, rows, i);
		memset(rows->lambda[i], 0, sizeof rows->lambda[i]);
	}
	return JN_OK;
}

int jn_contact_order(const JnContact* a, const JnContact* b) {
	const int left[] = {a->vertex_skin, a->vertex, a->other_skin, a->other_skin == JN_OBSTACLE_SKIN ? a->other : 0};
	const int right[] = {b->vertex_skin, b->vertex, b->other_skin, b->other_skin == JN_OBSTACLE_SKIN ? b->other : 0};
	for (int i = 0; i < 4; ++i)
		if (left[i] != right[i]) return left[i] < right[i] ? -1 : 1;
	return 0;
}

static void turn(const double from[9], const double lambda[3], const double to[9], double out[3]) {
	double force[3];
	for (int a = 0; a < 3; ++a) force[a] = from[a] * lambda[0] + from[3 + a] * lambda[1] + from[6 + a] * lambda[2];
	for (int r = 0; r < 3; ++r) out[r] = vec3_dot(to + 3 * (ptrdiff_t)r, force);
	if (out[0] < 0) out[0] = 0;
}

// Both lists are in the same order; among the contacts of a vertex with one body, the first goes to the first.
void jn_contact_rows_warm(JnContactRows* rows, const JnContactRows* old) {
	for (int i = 0, k = 0; i < rows->count && k < old->count;) {
		const int order = jn_contact_order(&rows->contact[i], &old->contact[k]);
		if (order == 0) turn(old->frame[k], old->lambda[k], rows->frame[i], rows->lambda[i]);
		i += order <= 0;
		k += order >= 0;
	}
}

JnContactProblem jn_contact_geometry(const JnContactRows* rows) {
	return (JnContactProblem){.count = rows->count,
							  .start = rows->start,
							  .node = rows->node,
							  .weight = rows->weight,
							  .frame = (const double(*)[9])rows->frame,
							  .friction = rows->friction};
}

JnStatus jn_contact_rows_reserve(JnContactRows* rows, int count, int entries) {
	const size_t n = (size_t)count, m = (size_t)entries;
	rows->count = 0;
	JN_TRY(jn_indices_reserve(&rows->indices, 3 * n + 1 + m));
	JN_TRY(jn_numbers_reserve(&rows->numbers, 17 * n + m));
	rows->start = rows->indices.at;
	rows->island = rows->start + n + 1;
	rows->source = rows->island + n;
	rows->node = rows->source + n;
	double* numbers = rows->numbers.at;
	rows->frame = (double(*)[9])numbers;
	rows->bound = (double(*)[3])(numbers + 9 * n);
	rows->lambda = (double(*)[3])(numbers + 12 * n);
	rows->friction = numbers + 15 * n;
	rows->gap = numbers + 16 * n;
	rows->weight = numbers + 17 * n;
	return jn_grow((void**)&rows->contact, &rows->contact_capacity, n, sizeof *rows->contact);
}

void jn_contact_rows_archive(JnContactRows* rows, JnArchive* archive) {
	const size_t each = sizeof *rows->contact + sizeof *rows->frame + sizeof *rows->lambda;
	const int count = jn_archive_count(archive, "contacts", rows->count, each);
	const JnStatus status = archive->is_reading ? jn_contact_rows_reserve(rows, count, 0) : JN_OK;
	if (archive->status == JN_OK) archive->status = status;
	if (archive->status != JN_OK) return;
	jn_archive_bytes(archive, "contact", rows->contact, (size_t)count * sizeof *rows->contact);
	jn_archive_reals(archive, "frame", (double*)rows->frame, 9 * (size_t)count);
	jn_archive_reals(archive, "lambda", (double*)rows->lambda, 3 * (size_t)count);
	rows->count = archive->status == JN_OK ? count : 0;
	for (int i = 0; archive->is_reading && i <= count; ++i) rows->start[i] = 0; // of nodes there are none
}

void jn_contact_rows_release(JnContactRows* rows) {
	free(rows->indices.at);
	free(rows->numbers.at);
	free(rows->contact);
	*rows = (JnContactRows){0};
}
