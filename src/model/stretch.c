// Between all nodes of an element, edges and diagonals alike. The pattern of the matrices would not do: models that have no
// matrix have only its diagonal.
#include "model/stretch.h"

#include <math.h>

static double distance(const double* x, int i, int j) {
	const double *a = x + 3 * (size_t)i, *b = x + 3 * (size_t)j;
	const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
	return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

static double element_stretch(const JnModel* model, const JnGroup* group, int e, const double* from, const double* to) {
	double most = 0;
	for (int i = 1; i < group->kernel->nodes; ++i)
		for (int j = 0; j < i; ++j) {
			const int a = jn_group_node(group, e, i), b = jn_group_node(group, e, j);
			const double rest = distance(model->rest, a, b), change = fabs(distance(to, a, b) - distance(from, a, b));
			most = fmax(most, change / (rest > 0 ? rest : 1));
		}
	return most;
}

double jn_model_stretch(const JnModel* model, const double* from, const double* to) {
	double most = 0;
	for (int g = 0; g < model->group_count; ++g)
		for (int e = 0; e < model->groups[g].count; ++e)
			most = fmax(most, element_stretch(model, &model->groups[g], e, from, to));
	return most;
}
