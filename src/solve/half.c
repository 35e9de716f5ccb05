#include "solve/half.h"

#include <stdlib.h>

#include "math/lapack.h"

void jn_half_clear(JnHalf* half) {
	half->count = half->piece_count = half->panels = 0;
	half->columns = half->values = 0;
}

void jn_half_release(JnHalf* half) {
	free(half->pieces);
	free(half->column);
	free(half->value);
	free(half->latest);
	free(half->front);
	free(half->stack);
	free(half->marks);
	free(half->left);
	*half = (JnHalf){0};
}

JnStatus jn_half_begin(JnHalf* half, int panels) {
	JN_TRY(jn_grow((void**)&half->latest, &half->latest_capacity, (size_t)panels, sizeof *half->latest));
	for (; half->panels < panels; ++half->panels) half->latest[half->panels] = -1;
	return JN_OK;
}

JnStatus jn_half_append(JnHalf* half, int panel, int rows, int count, JnHalfPiece** out) {
	const size_t values = (size_t)rows * (size_t)count;
	JN_TRY(jn_grow((void**)&half->pieces, &half->piece_capacity, (size_t)half->piece_count + 1, sizeof *half->pieces));
	JN_TRY(jn_grow((void**)&half->column, &half->column_capacity, half->columns + (size_t)count, sizeof *half->column));
	JN_TRY(jn_grow((void**)&half->value, &half->value_capacity, half->values + values, sizeof *half->value));
	*out = &half->pieces[half->piece_count];
	**out = (JnHalfPiece){panel, rows, count, half->latest[panel], half->columns, half->values};
	half->latest[panel] = half->piece_count++;
	half->columns += (size_t)count;
	half->values += values;
	return JN_OK;
}

// The products of two pieces of a panel: a is b, or came later.
static JnStatus add_products(JnHalf* half, const JnHalfPiece* a, const JnHalfPiece* b, size_t stride, double* matrix) {
	const double one = 1, zero = 0;
	const size_t count = (size_t)a->count * (size_t)b->count;
	JN_TRY(jn_grow((void**)&half->front, &half->front_capacity, count, sizeof *half->front));
	const double *left = half->value + a->value, *right = half->value + b->value;
	if (a == b)
		dsyrk_("L", "T", &a->count, &a->rows, &one, left, &a->rows, &zero, half->front, &a->count, 1, 1);
	else
		dgemm_("T", "N", &a->count, &b->count, &a->rows, &one, left, &a->rows, right, &b->rows, &zero, half->front,
			   &a->count, 1, 1);
	const int* row = half->column + a->column;
	for (int j = 0; j < b->count; ++j) {
		const double* from = half->front + (size_t)j * (size_t)a->count;
		double* to = matrix + stride * (size_t)half->column[b->column + (size_t)j];
		for (int i = a == b ? j : 0; i < a->count; ++i) to[row[i]] += from[i];
	}
	return JN_OK;
}

JnStatus jn_half_products(JnHalf* half, int first, size_t stride, double* matrix) {
	for (int k = 0; k < half->piece_count; ++k) {
		const JnHalfPiece* piece = &half->pieces[k];
		if (half->column[piece->column] < first) continue;
		for (int other = k; other >= 0; other = half->pieces[other].earlier)
			JN_TRY(add_products(half, piece, &half->pieces[other], stride, matrix));
	}
	return JN_OK;
}
