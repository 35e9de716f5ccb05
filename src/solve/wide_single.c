// Compiled once a vector width; see single.h. Sums run in JN_SINGLE_LANES accumulators: their order is that of no width.
// Columns go in fours, so that the vector beside them is read and written once for four.
#include "solve/single.h"

#include <string.h>

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

enum { LANES = JN_SINGLE_LANES, FOUR = 4, SIDE = 2 * JN_WIDE, PARTS = LANES / SIDE };

typedef float Part __attribute__((vector_size(SIDE * sizeof(float)), may_alias)); // of the lanes: a register

// Up to four columns of a panel, the first of them `at`.
typedef struct Columns {
	const float *x, *inverse; // entries, 1 / diagonal
	int at, count, stride;
} Columns;

static inline float entry(const Columns* c, int row, int column) {
	return c->x[(ptrdiff_t)column * c->stride + c->at + row];
}

// t <- t - columns * their part of t, which is solved first. What lies above the diagonal is zero; the columns' own rows,
// which whole lanes cover as well, are put back.
static inline void forward_columns(const Columns* c, int count, float* t) {
	float own[FOUR];
	for (int j = 0; j < count; ++j) {
		float sum = t[c->at + j];
		for (int k = 0; k < j; ++k) sum -= entry(c, j, k) * own[k];
		own[j] = sum * c->inverse[j];
	}
	for (int i = c->at / LANES * LANES; i < c->stride; i += SIDE) {
		Part rest = *(const Part*)(t + i);
		for (int j = 0; j < count; ++j) rest -= *(const Part*)(c->x + (ptrdiff_t)j * c->stride + i) * own[j];
		*(Part*)(t + i) = rest;
	}
	for (int j = 0; j < count; ++j) t[c->at + j] = own[j];
}

static inline float total(const Part sum[PARTS]) {
	float lane[LANES];
	memcpy(lane, sum, sizeof lane);
	for (int half = LANES / 2; half > 0; half /= 2)
		for (int l = 0; l < half; ++l) lane[l] += lane[l + half];
	return lane[0];
}

// The columns' part of t from the rows behind it.
static inline void backward_columns(const Columns* c, int count, float* t) {
	float own[FOUR];
	Part sum[FOUR][PARTS] = {{{0}}};
	for (int j = 0; j < count; ++j) own[j] = t[c->at + j];
	for (int j = 0; j < count; ++j) t[c->at + j] = 0;
	for (int i = c->at / LANES * LANES; i < c->stride; i += LANES)
		for (int p = 0; p < PARTS; ++p)
			for (int j = 0; j < count; ++j)
				sum[j][p] +=
					*(const Part*)(c->x + (ptrdiff_t)j * c->stride + i + p * SIDE) * *(const Part*)(t + i + p * SIDE);
	for (int j = count - 1; j >= 0; --j) {
		float rest = own[j] - total(sum[j]);
		for (int k = j + 1; k < count; ++k) rest -= entry(c, k, j) * own[k];
		own[j] = rest * c->inverse[j];
	}
	for (int j = 0; j < count; ++j) t[c->at + j] = own[j];
}

static Columns columns_at(const JnSingleFactor* L, int s, int column) {
	const int columns = L->super[s + 1] - L->super[s], stride = jn_single_stride(L->pi[s + 1] - L->pi[s]);
	return (Columns){.x = L->x + L->panel[s] + (ptrdiff_t)column * stride,
					 .inverse = L->inverse + L->super[s] + column,
					 .at = column,
					 .count = columns - column < FOUR ? columns - column : FOUR,
					 .stride = stride};
}

static void forward(const JnSingleFactor* L, int s, float* x, float* t) {
	const int first = L->super[s], columns = L->super[s + 1] - first, rows = L->pi[s + 1] - L->pi[s];
	const int stride = jn_single_stride(rows), *row = L->rows + L->pi[s];
	for (int i = 0; i < columns; ++i) t[i] = x[first + i];
	for (int i = columns; i < stride; ++i) t[i] = 0;
	for (int j = 0; j < columns; j += FOUR) {
		const Columns c = columns_at(L, s, j);
		if (c.count == FOUR)
			forward_columns(&c, FOUR, t);
		else
			forward_columns(&c, c.count, t);
	}
	for (int i = 0; i < columns; ++i) x[first + i] = t[i];
	for (int i = columns; i < rows; ++i) x[row[i]] += t[i];
}

static void backward(const JnSingleFactor* L, int s, float* x, float* t) {
	const int first = L->super[s], columns = L->super[s + 1] - first, rows = L->pi[s + 1] - L->pi[s];
	const int stride = jn_single_stride(rows), *row = L->rows + L->pi[s];
	for (int i = 0; i < columns; ++i) t[i] = x[first + i];
	for (int i = columns; i < rows; ++i) t[i] = x[row[i]];
	for (int i = rows; i < stride; ++i) t[i] = 0;
	for (int j = (columns - 1) / FOUR * FOUR; j >= 0; j -= FOUR) {
		const Columns c = columns_at(L, s, j);
		if (c.count == FOUR)
			backward_columns(&c, FOUR, t);
		else
			backward_columns(&c, c.count, t);
	}
	for (int i = 0; i < columns; ++i) x[first + i] = t[i];
}

JnSingleSolve JOIN(jn_single_solve_, JN_WIDE);

void JOIN(jn_single_solve_, JN_WIDE)(const JnSingleFactor* factor, float* x, float* work) {
	for (int s = 0; s < factor->supernodes; ++s) forward(factor, s, x, work);
	for (int s = factor->supernodes - 1; s >= 0; --s) backward(factor, s, x, work);
}
