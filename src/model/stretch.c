// Nodes of one element are neighbours in the pattern of the matrices: edges and diagonals alike.
#include "model/stretch.h"

#include <math.h>

static double distance(const double* x, int i, int j) {
	const double *a = x + 3 * (size_t)i, *b = x + 3 * (size_t)j;
	const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
	return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

double jn_model_stretch(const JnModel* model, const double* from, const double* to) {
	const JnPattern* pattern = &model->pattern;
	double most = 0;
	for (int column = 0; column < pattern->nodes; ++column)
		for (int k = pattern->column_start[column] + 1; k < pattern->column_start[column + 1]; ++k) {
			const int row = pattern->row[k];
			const double rest = distance(model->rest, row, column);
			const double change = fabs(distance(to, row, column) - distance(from, row, column));
			most = fmax(most, change / (rest > 0 ? rest : 1));
		}
	return most;
}
