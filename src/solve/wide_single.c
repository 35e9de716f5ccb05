// Compiled once a vector width; see single.h. Sums run in JN_SINGLE_LANES accumulators: their order is that of no width.
#include "solve/single.h"

#include <string.h>

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

enum { LANES = JN_SINGLE_LANES };

typedef float Lanes __attribute__((vector_size(LANES * sizeof(float))));

// t -= column * scale over the lanes from that of `first` on; what lies above the diagonal is zero.
static inline void subtract_column(const float* column, float scale, int first, int stride, float* t) {
	for (int i = first / LANES * LANES; i < stride; i += LANES) *(Lanes*)(t + i) -= *(const Lanes*)(column + i) * scale;
}

static inline float dot_column(const float* column, int first, int stride, const float* t) {
	Lanes sum = {0};
	for (int i = first / LANES * LANES; i < stride; i += LANES)
		sum += *(const Lanes*)(column + i) * *(const Lanes*)(t + i);
	float lane[LANES];
	memcpy(lane, &sum, sizeof lane);
	for (int half = LANES / 2; half > 0; half /= 2)
		for (int l = 0; l < half; ++l) lane[l] += lane[l + half];
	return lane[0];
}

static void forward(const JnSingleFactor* L, int s, float* x, float* t) {
	const int first = L->super[s], columns = L->super[s + 1] - first, rows = L->pi[s + 1] - L->pi[s];
	const int stride = jn_single_stride(rows), *row = L->rows + L->pi[s];
	for (int i = 0; i < columns; ++i) t[i] = x[first + i];
	for (int i = columns; i < stride; ++i) t[i] = 0;
	for (int j = 0; j < columns; ++j) {
		t[j] *= L->inverse[first + j];
		subtract_column(L->x + L->panel[s] + (ptrdiff_t)j * stride, t[j], j, stride, t);
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
	for (int j = columns - 1; j >= 0; --j) {
		const float dot = dot_column(L->x + L->panel[s] + (ptrdiff_t)j * stride, j, stride, t);
		t[j] = (t[j] - dot) * L->inverse[first + j];
	}
	for (int i = 0; i < columns; ++i) x[first + i] = t[i];
}

JnSingleSolve JOIN(jn_single_solve_, JN_WIDE);

void JOIN(jn_single_solve_, JN_WIDE)(const JnSingleFactor* factor, float* x, float* work) {
	for (int s = 0; s < factor->supernodes; ++s) forward(factor, s, x, work);
	for (int s = factor->supernodes - 1; s >= 0; --s) backward(factor, s, x, work);
}
