#include "force/constraint/rest.h"

#include <math.h>
#include <stddef.h>

#include "force/constraint/angle.h"
#include "force/constraint/area.h"
#include "force/constraint/link.h"
#include "math/vec3.h"

static const double* at(const JnMesh* mesh, int node) {
	return mesh->nodes + 3 * (ptrdiff_t)node;
}

double jn_rest_length(const JnMesh* mesh, const int nodes[2]) {
	return vec3_distance(at(mesh, nodes[0]), at(mesh, nodes[1]));
}

void jn_rest_strut(const JnMesh* mesh, const int nodes[2], double k, double* rest) {
	rest[SPRING_LENGTH] = jn_rest_length(mesh, nodes);
	rest[SPRING_STIFFNESS] = k;
}

// Edges from the last node, each number in all lanes: rest and moved elements are measured by the same formulas.
static void edges_of(const JnMesh* mesh, const int* nodes, int count, Wide edges[][3]) {
	for (int i = 0; i < count - 1; ++i)
		for (int a = 0; a < 3; ++a) edges[i][a] = wide_set(at(mesh, nodes[i])[a] - at(mesh, nodes[count - 1])[a]);
}

void jn_rest_volume(const JnMesh* mesh, const int nodes[4], double modulus, double nonlinear_modulus, double* rest) {
	Wide edges[3][3], across[3];
	edges_of(mesh, nodes, 4, edges);
	wide_cross(edges[1], edges[2], across);
	const double V = wide_dot(edges[0], across)[0] / 6;
	rest[VOLUME_REST] = V;
	rest[VOLUME_STIFFNESS] = modulus / fabs(V);
	rest[VOLUME_NONLINEAR] = nonlinear_modulus / fabs(V);
}

void jn_rest_guard(const JnMesh* mesh, const int nodes[4], double share, double nonlinear_modulus, double* rest) {
	jn_rest_volume(mesh, nodes, 0, nonlinear_modulus, rest);
	rest[VOLUME_REST] *= share;
	rest[VOLUME_NONLINEAR] /= share;
}

void jn_rest_area(const JnMesh* mesh, const int nodes[3], double stiffness, double* rest) {
	double normal[3];
	vec3_triangle(at(mesh, nodes[0]), at(mesh, nodes[1]), at(mesh, nodes[2]), normal);
	const double area = 0.5 * vec3_length(normal);
	rest[AREA_REST] = area;
	rest[AREA_STIFFNESS] = stiffness / area;
}

void jn_rest_angle(const JnMesh* mesh, const int nodes[3], double k, double* rest) {
	double a[3], b[3], across[3];
	for (int i = 0; i < 3; ++i) {
		a[i] = at(mesh, nodes[2])[i] - at(mesh, nodes[0])[i];
		b[i] = at(mesh, nodes[1])[i] - at(mesh, nodes[2])[i];
	}
	vec3_cross(a, b, across);
	rest[ANGLE_REST] = atan2(vec3_length(across), vec3_dot(a, b));
	rest[ANGLE_STIFFNESS] = k;
}

// v = beta p + gamma q is perpendicular to u = p and as long.
static FrameSection section_of(const JnMesh* mesh, const int nodes[LINK_NODES], double* rest) {
	double p[3], q[3];
	for (int a = 0; a < 3; ++a) {
		p[a] = at(mesh, nodes[1])[a] - at(mesh, nodes[0])[a];
		q[a] = at(mesh, nodes[2])[a] - at(mesh, nodes[0])[a];
	}
	const double pp = vec3_dot(p, p), along = vec3_dot(p, q) / pp, qq = vec3_dot(q, q);
	rest[FRAME_GAMMA] = sqrt(pp / (qq - along * along * pp));
	rest[FRAME_BETA] = -along * rest[FRAME_GAMMA];
	return (FrameSection){wide_set(rest[FRAME_BETA]), wide_set(rest[FRAME_GAMMA])};
}

void jn_rest_torsion(const JnMesh* mesh, const int nodes[LINK_NODES], double k, double* rest) {
	Wide edges[LINK_NODES - 1][3];
	FramePair f;
	const FrameSection section = section_of(mesh, nodes, rest);
	edges_of(mesh, nodes, LINK_NODES, edges);
	frame_vectors(&section, edges, &f);
	const double N = (wide_dot(f.v[0], f.u[1]) - wide_dot(f.u[0], f.v[1]))[0];
	const double D = (wide_dot(f.u[0], f.u[1]) + wide_dot(f.v[0], f.v[1]))[0];
	rest[TORSION_SINE] = N / hypot(N, D);
	rest[TORSION_COSINE] = D / hypot(N, D);
	rest[TORSION_STIFFNESS] = k;
}

void jn_rest_skew(const JnMesh* mesh, const int nodes[LINK_NODES], double shear_stiffness, double* rest) {
	Wide edges[LINK_NODES - 1][3], t[3], u[3], v[3];
	const FrameSection section = section_of(mesh, nodes, rest);
	edges_of(mesh, nodes, LINK_NODES, edges);
	skew_vectors(&section, edges, t, u, v);
	const double side = jn_rest_length(mesh, nodes), length = sqrt(wide_dot(t, t)[0]) / 3;
	rest[SKEW_U] = wide_dot(t, u)[0];
	rest[SKEW_V] = wide_dot(t, v)[0];
	rest[SKEW_STIFFNESS] = shear_stiffness / (36 * length * side * side);
}

void jn_link_nodes(const JnThread* thread, int link, int nodes[LINK_NODES]) {
	for (int i = 0; i < JN_FRAME_NODES; ++i) {
		nodes[i] = JN_FRAME_NODES * link + i;
		nodes[JN_FRAME_NODES + i] = JN_FRAME_NODES * jn_thread_end(thread, link) + i;
	}
}

double jn_link_length(const JnMesh* mesh, int link) {
	int nodes[LINK_NODES];
	double step[3] = {0};
	jn_link_nodes(mesh->thread, link, nodes);
	for (int i = 0; i < JN_FRAME_NODES; ++i)
		for (int a = 0; a < 3; ++a)
			step[a] += mesh->thread->axis[i] * (at(mesh, nodes[JN_FRAME_NODES + i])[a] - at(mesh, nodes[i])[a]);
	return vec3_length(step);
}

double jn_thread_density(const JnMesh* mesh, double density) {
	double length = 0, volume = 0;
	for (int link = 0; link < jn_thread_links(mesh->thread); ++link) length += jn_link_length(mesh, link);
	for (int cell = 0; cell < mesh->cell_count; ++cell) volume += jn_mesh_cell_volume(mesh, cell);
	return density * 3.14159265358979323846 * mesh->thread->radius * mesh->thread->radius * length / volume;
}

JnStatus jn_constraint_add(JnConstraintKernel which, int count, JnConstraint* elements, int first_node, double damping,
						   JnArena* arena, JnGroups* out) {
	if (count == 0) return JN_OK;
	const JnKernel* kernel = jn_constraint_kernel(which, 0);
	for (int e = 0; e < count; ++e)
		for (int i = 0; i < kernel->nodes; ++i) elements[e].nodes[i] += first_node;
	JnGroup* group = &out->list[out->count++];
	JN_TRY(jn_constraint_group_create(kernel, count, elements, arena, group));
	group->damping = damping;
	return JN_OK;
}

JnStatus jn_thread_add_end(const JnMesh* mesh, double k, int first_node, double damping, JnArena* arena,
						   JnGroups* out) {
	JnConstraint struts[LINK_SIDES];
	const int last = JN_FRAME_NODES * (mesh->thread->frame_count - 1);
	if (mesh->thread->is_closed) return JN_OK;
	for (int i = 0; i < LINK_SIDES; ++i) {
		struts[i] = (JnConstraint){.nodes = {last + link_struts[i][0], last + link_struts[i][1]}};
		jn_rest_strut(mesh, struts[i].nodes, k, struts[i].rest);
	}
	return jn_constraint_add(JN_CONSTRAINT_strut, LINK_SIDES, struts, first_node, damping, arena, out);
}
