// The law `peridynamic`: its keys, and the bonds of a body.
#include "force/peridynamic.h"

#include <math.h>
#include <stdio.h>

#include "base/log.h"
#include "force/bond.h"
#include "math/vec3.h"

static const double PI = 3.14159265358979323846;
static const double MOST_BONDS = 2e8; // some 10 GB with what a model keeps of each

static const char* const volume_names[] = {"none", "partial", NULL};
static const char* const surface_names[] = {"none", "volume", "energy", NULL};

#define POSITIVE(field_name, is_needed, unit_text, words)                                                              \
	{                                                                                                                  \
		.name = #field_name, .kind = JN_REAL, .field = offsetof(JnPeridynamicDef, field_name), .high = INFINITY,       \
		.open = JN_OPEN_LOW | JN_OPEN_HIGH, .required = (is_needed), .absent_allowed = !(is_needed),                   \
		.unit = (unit_text), .meaning = (words)                                                                        \
	}
#define PLACE(type, field_name, is_needed, words)                                                                      \
	{                                                                                                                  \
		.name = #field_name, .kind = JN_REAL3, .field = offsetof(type, field_name), .required = (is_needed),           \
		.absent_allowed = !(is_needed), .unit = "m", .meaning = (words)                                                \
	}

static const JnKey notch_keys[] = {
	PLACE(JnNotchDef, from, true, "one end of an edge of the cut"),
	PLACE(JnNotchDef, to, true, "the other end"),
	PLACE(JnNotchDef, across, false,
		  "the edge that leaves from both ends, a vector: the cut is a parallelogram; along z through everything when "
		  "absent"),
	{.name = NULL},
};

static const JnKey unbreakable_keys[] = {
	PLACE(JnUnbreakableDef, min, true, "lowest corner"),
	PLACE(JnUnbreakableDef, max, true, "highest corner"),
	{.name = NULL},
};

static const JnKey keys[] = {
	POSITIVE(density, true, "kg/m^3", "mass a volume at rest"),
	POSITIVE(young, true, "Pa", "Young's modulus; Poisson's ratio is 1/4, and 1/3 in a layer under plane stress"),
	POSITIVE(horizon, false, "m", "distance up to which points are bonded; or give horizon_spacings"),
	POSITIVE(horizon_spacings, false, "",
			 "the same as a multiple of the spacing of the points; 3 when both are absent"),
	POSITIVE(critical_stretch, false, "", "a bond breaks when it is longer by this share; or give fracture_energy"),
	POSITIVE(fracture_energy, false, "J/m^2", "energy that an area of crack costs; or give critical_stretch"),
	{.name = "volume",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnPeridynamicDef, volume),
	 .value = {JN_VOLUME_PARTIAL},
	 .names = volume_names,
	 .meaning = "points whose cells the rim of the horizon cuts: partial, they count in part; none, they count in full "
				"when they lie inside"},
	{.name = "surface",
	 .kind = JN_CHOICE,
	 .field = offsetof(JnPeridynamicDef, surface),
	 .value = {JN_SURFACE_ENERGY},
	 .names = surface_names,
	 .meaning =
		 "stiffer bonds where a part of the horizon is missing: energy, so that a uniform strain along each axis "
		 "has the energy of the continuum; volume, by the volume missing; none, and surfaces are soft"},
	{.name = "notches",
	 .kind = JN_LIST,
	 .field = offsetof(JnPeridynamicDef, notches),
	 .keys = notch_keys,
	 .size = sizeof(JnNotchDef),
	 .meaning = "cuts that are there from the start"},
	{.name = "unbreakable",
	 .kind = JN_LIST,
	 .field = offsetof(JnPeridynamicDef, unbreakable),
	 .keys = unbreakable_keys,
	 .size = sizeof(JnUnbreakableDef),
	 .meaning = "boxes, at rest, whose points keep all their bonds, such as those that are loaded"},
	{.name = NULL},
};

static JnStatus check_choices(const JnPeridynamicDef* def, const char* what) {
	const bool has_stretch = !isnan(def->critical_stretch), has_energy = !isnan(def->fracture_energy);
	if (has_stretch && has_energy)
		return jn_error(
			JN_BAD_INPUT,
			"%s.material.fracture_energy: critical_stretch is given as well, and one follows from the other; "
			"give one of them",
			what);
	if (!has_stretch && !has_energy)
		return jn_error(JN_BAD_INPUT,
						"%s.material: nothing says when bonds break; give fracture_energy or critical_stretch (such as "
						"1000 for never)",
						what);
	if (isnan(def->horizon) || isnan(def->horizon_spacings)) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s.material.horizon: horizon_spacings is given as well; give one of them", what);
}

static double mean_volume(const JnMesh* mesh) {
	double sum = 0;
	for (int i = 0; i < mesh->node_count; i++) sum += mesh->volumes[i];
	return sum / mesh->node_count;
}

// delta, c and s0; see peridynamic.h.
static void find_constants(JnPeridynamics* body) {
	const JnPeridynamicDef* def = body->def;
	const double E = def->young, t = body->mesh->thickness, volume = mean_volume(body->mesh);
	const bool is_layer = body->dimensions == 2;
	body->spacing = is_layer ? sqrt(volume / t) : cbrt(volume);
	const double spacings = isnan(def->horizon_spacings) ? 3 : def->horizon_spacings;
	const double delta = isnan(def->horizon) ? spacings * body->spacing : def->horizon, k = 2 * E / 3;
	body->horizon = delta;
	body->modulus = is_layer ? 9 * E / (PI * t * pow(delta, 3)) : 18 * k / (PI * pow(delta, 4));
	body->stretch = def->critical_stretch;
	if (isnan(body->stretch))
		body->stretch = sqrt(is_layer ? 4 * PI * def->fracture_energy / (9 * E * delta)
									  : 5 * def->fracture_energy / (9 * k * delta));
}

static JnStatus check_horizon(const JnPeridynamics* body) {
	const double ratio = body->horizon / body->spacing;
	const double around = body->dimensions == 2 ? PI * ratio * ratio : 4.0 / 3 * PI * ratio * ratio * ratio;
	const double neighbours = fmin(around, body->mesh->node_count), bonds = 0.5 * body->mesh->node_count * neighbours;
	if (ratio < 1 - 1e-9)
		return jn_error(JN_BAD_INPUT,
						"%s.material.horizon: %g m is less than the spacing of the points, %g m, so that none has a "
						"neighbour; use about 3 spacings",
						body->what, body->horizon, body->spacing);
	if (bonds <= MOST_BONDS) return JN_OK;
	return jn_error(
		JN_BAD_INPUT,
		"%s.material.horizon: %d points with some %.0f neighbours each are %.2g bonds, more than %.0g; use a "
		"smaller horizon (now %.1f spacings) or a larger spacing",
		body->what, body->mesh->node_count, neighbours, bonds, MOST_BONDS, ratio);
}

static JnStatus find_pairs(JnPeridynamics* body) {
	const double rim = body->def->volume == JN_VOLUME_PARTIAL ? body->spacing / 2 : 0;
	char what[128];
	snprintf(what, sizeof what, "%s.material.horizon", body->what);
	JN_TRY(jn_neighbours_find(body->mesh->nodes, body->mesh->node_count, body->horizon + rim, what, &body->pairs));
	if (body->pairs.starts[body->mesh->node_count] > 0) return JN_OK;
	return jn_error(JN_BAD_INPUT, "%s: no two of the %d points are within %g m; use a larger horizon", what,
					body->mesh->node_count, body->horizon);
}

static double length_of(const JnMesh* mesh, int i, int j) {
	return vec3_distance(mesh->nodes + 3 * (ptrdiff_t)i, mesh->nodes + 3 * (ptrdiff_t)j);
}

double jn_peridynamic_share(const JnPeridynamics* body, double length) {
	if (body->def->volume == JN_VOLUME_NONE) return 1;
	return fmin(1, fmax(0, (body->horizon + body->spacing / 2 - length) / body->spacing));
}

static bool is_unbreakable(const JnPeridynamics* body, int point) {
	const double* x = body->mesh->nodes + 3 * (ptrdiff_t)point;
	for (int i = 0; i < body->def->unbreakable.count; i++) {
		const JnUnbreakableDef* box = (const JnUnbreakableDef*)body->def->unbreakable.data + i;
		bool is_in = true;
		for (int a = 0; a < 3; a++) is_in &= x[a] >= box->min[a] && x[a] <= box->max[a];
		if (is_in) return true;
	}
	return false;
}

// A pair is a bond unless it is cut, or no volume is left of it at the rim.
static bool is_bond(const JnPeridynamics* body, const bool* is_cut, int pair, double length) {
	return !is_cut[pair] && length > 0 && jn_peridynamic_share(body, length) > 1e-9;
}

static int count_bonds(const JnPeridynamics* body, const bool* is_cut) {
	int count = 0;
	for (int i = 0; i < body->mesh->node_count; i++)
		for (int p = body->pairs.starts[i]; p < body->pairs.starts[i + 1]; p++)
			count += is_bond(body, is_cut, p, length_of(body->mesh, i, body->pairs.list[p]));
	return count;
}

// k = c V_i V_j, times the corrections.
static void set_bonds(const JnPeridynamics* body, const bool* is_cut, const double* scale, int first_node,
					  JnGroup* group) {
	int bond = 0;
	for (int i = 0; i < body->mesh->node_count; i++) {
		const bool is_tough = is_unbreakable(body, i);
		for (int p = body->pairs.starts[i]; p < body->pairs.starts[i + 1]; p++) {
			const int j = body->pairs.list[p];
			const double length = length_of(body->mesh, i, j);
			if (!is_bond(body, is_cut, p, length)) continue;
			const double* V = body->mesh->volumes;
			const JnBond made = {.nodes = {first_node + i, first_node + j},
								 .length = length,
								 .force = body->modulus * V[i] * V[j] * jn_peridynamic_share(body, length) * scale[p],
								 .stretch = is_tough || is_unbreakable(body, j) ? INFINITY : body->stretch};
			jn_bond_set(group, bond++, &made);
		}
	}
	jn_bonds_pad(group);
}

static void keep_constants(const JnPeridynamics* body, JnGroup* group) {
	const double area = mean_volume(body->mesh) / body->spacing;
	group->constants[JN_BOND_MODULUS] = body->modulus;
	group->constants[JN_BOND_HORIZON] = body->horizon;
	group->constants[JN_BOND_SPACING] = body->spacing;
	group->constants[JN_BOND_STIFFNESS] = body->def->young * area / body->spacing;
}

static JnStatus make_bonds(JnPeridynamics* body, int first_node, JnArena* scratch, JnArena* arena, JnGroup* group) {
	double* scale;
	bool* is_cut;
	JN_TRY(check_horizon(body));
	JN_TRY(find_pairs(body));
	const size_t pairs = (size_t)body->pairs.starts[body->mesh->node_count];
	JN_NEW(scratch, scale, pairs);
	JN_NEW(scratch, is_cut, pairs);
	JN_TRY(jn_peridynamic_correct(body, scratch, scale));
	JN_TRY(jn_peridynamic_cut(body, is_cut));
	JN_TRY(jn_bonds_create(count_bonds(body, is_cut), arena, group));
	set_bonds(body, is_cut, scale, first_node, group);
	keep_constants(body, group);
	return JN_OK;
}

JnStatus jn_peridynamic_build(const JnLaw* law, const void* options, const JnMesh* mesh, int first_node,
							  const char* what, JnArena* arena, JnGroups* out) {
	JnPeridynamics body = {.def = options, .mesh = mesh, .what = what, .dimensions = mesh->thickness > 0 ? 2 : 3};
	if (mesh->shape != JN_POINT1)
		return jn_error(JN_BAD_INPUT,
						"%s.material.law: '%s' runs on points, not on %s elements; use the shape points_box "
						"or points_file",
						what, law->row.name, jn_shape_info[mesh->shape].name);
	JN_TRY(check_choices(body.def, what));
	find_constants(&body);
	*out = (JnGroups){.count = 1, .density = body.def->density};
	JN_NEW(arena, out->list, 1);
	JnArena scratch = {0};
	const JnStatus status = make_bonds(&body, first_node, &scratch, arena, out->list);
	jn_neighbours_release(&body.pairs);
	jn_arena_free(&scratch);
	return status;
}

const JnLaw jn_law_peridynamic = {
	.row = {"peridynamic",
			"Bond-based peridynamics, microelastic and brittle (Silling & Askari 2005): a body of points that "
			"cracks.",
			keys, sizeof(JnPeridynamicDef)},
	.build = jn_peridynamic_build,
};
