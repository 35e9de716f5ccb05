#include "solve/block_factor.h"

#include <string.h>

#include "math/lapack.h"

enum { WORD = 32 };

JnStatus jn_block_begin(JnBlockFactor* f, int count) {
	const size_t n = (size_t)count;
	f->count = count;
	f->words = count / WORD + 1;
	JN_TRY(jn_indices_reserve(&f->indices, 6 * n + 2));
	JN_TRY(jn_indices_reserve(&f->bits, (n + 1) * (size_t)f->words));
	JN_TRY(jn_numbers_reserve(&f->offsets, 3 * n + 1));
	f->place = f->indices.at;
	f->size = f->place + n;
	f->order = f->size + n;
	f->offset_of = f->order + n;
	f->first = f->offset_of + n;
	f->start = f->first + n + 1;
	f->meets = (unsigned*)f->bits.at;
	_Static_assert(sizeof(size_t) == sizeof(double), "offsets share the memory of numbers");
	f->diagonal = (void*)f->offsets.at;
	f->below = f->diagonal + n;
	f->beside = f->below + n;
	memset(f->size, 0, n * sizeof *f->size);
	memset(f->meets, 0, n * (size_t)f->words * sizeof *f->meets);
	return JN_OK;
}

void jn_block_release(JnBlockFactor* f) {
	free(f->later.at);
	free(f->indices.at);
	free(f->bits.at);
	free(f->numbers.at);
	free(f->product.at);
	free(f->vector.at);
	free(f->offsets.at);
}

static unsigned* row_of(const JnBlockFactor* f, int group) {
	return f->meets + (size_t)group * (size_t)f->words;
}

static bool has(const unsigned* bits, int group) {
	return bits[group / WORD] >> group % WORD & 1;
}

// The next group of a set from `group` on, or `count`.
static int next_of(const JnBlockFactor* f, const unsigned* bits, int group) {
	for (int w = group / WORD; w < f->words; ++w) {
		const unsigned word = w == group / WORD ? bits[w] & ~0u << group % WORD : bits[w];
		if (word != 0) return w * WORD + __builtin_ctz(word);
	}
	return f->count;
}

// Unknowns of the groups that a group meets and that are left.
static int degree_of(const JnBlockFactor* f, int group) {
	int sum = 0;
	const unsigned* bits = row_of(f, group);
	for (int g = next_of(f, bits, 0); g < f->count; g = next_of(f, bits, g + 1)) sum += g != group ? f->size[g] : 0;
	return sum;
}

// What a group meets becomes a clique without it.
static void eliminate_group(JnBlockFactor* f, int group, int* degree) {
	unsigned* bits = row_of(f, group);
	bits[group / WORD] &= ~(1u << group % WORD);
	for (int g = next_of(f, bits, 0); g < f->count; g = next_of(f, bits, g + 1)) {
		unsigned* other = row_of(f, g);
		for (int w = 0; w < f->words; ++w) other[w] |= bits[w];
		other[group / WORD] &= ~(1u << group % WORD);
	}
	for (int g = next_of(f, bits, 0); g < f->count; g = next_of(f, bits, g + 1)) degree[g] = degree_of(f, g);
}

static void find_order(JnBlockFactor* f) {
	int* degree = f->offset_of;
	for (int g = 0; g < f->count; ++g) {
		f->place[g] = -1;
		degree[g] = degree_of(f, g);
	}
	for (int p = 0; p < f->count; ++p) {
		int best = -1;
		for (int g = 0; g < f->count; ++g)
			if (f->place[g] < 0 && (best < 0 || degree[g] < degree[best])) best = g;
		f->place[best] = p;
		f->order[p] = best;
		eliminate_group(f, best, degree);
	}
}

// What is left in the row of a group are those after it; in the order of places.
static JnStatus list_later(JnBlockFactor* f) {
	size_t total = 0;
	int unknowns = 0;
	for (int g = 0; g < f->count; ++g) {
		unknowns += f->size[g];
		for (int k = next_of(f, row_of(f, g), 0); k < f->count; k = next_of(f, row_of(f, g), k + 1)) ++total;
	}
	JN_TRY(jn_indices_reserve(&f->later, 2 * total + (size_t)unknowns));
	f->offset = f->later.at + total;
	f->pivots = f->offset + total;
	f->start[0] = f->first[0] = 0;
	for (int p = 0; p < f->count; ++p) {
		const unsigned* bits = row_of(f, f->order[p]);
		int end = f->start[p], offset = 0;
		for (int q = p + 1; q < f->count; ++q) {
			if (!has(bits, f->order[q])) continue;
			f->later.at[end] = q;
			f->offset[end++] = offset;
			offset += f->size[f->order[q]];
		}
		f->start[p + 1] = end;
		f->first[p + 1] = f->first[p] + f->size[f->order[p]];
	}
	return JN_OK;
}

static int own_count(const JnBlockFactor* f, int p) {
	return f->first[p + 1] - f->first[p];
}

static int later_count(const JnBlockFactor* f, int p) {
	const int last = f->start[p + 1] - 1;
	return last < f->start[p] ? 0 : f->offset[last] + own_count(f, f->later.at[last]);
}

JnStatus jn_block_analyze(JnBlockFactor* f, bool is_symmetric) {
	f->is_symmetric = is_symmetric;
	find_order(f);
	JN_TRY(list_later(f));
	f->work = 0;
	for (int p = 0; p < f->count; ++p) {
		const double own = own_count(f, p), later = later_count(f, p);
		f->work += (is_symmetric ? 1 : 2) * own * (own * own / 3 + own * later + later * later);
	}
	return JN_OK;
}

JnStatus jn_block_clear(JnBlockFactor* f) {
	size_t end = 0, most = 0;
	for (int p = 0; p < f->count; ++p) {
		const size_t own = (size_t)own_count(f, p), later = (size_t)later_count(f, p);
		f->diagonal[p] = end;
		f->below[p] = f->diagonal[p] + own * own;
		f->beside[p] = f->below[p] + own * later;
		end = f->beside[p] + (f->is_symmetric ? 0 : own * later);
		most = later * later > most ? later * later : most;
	}
	JN_TRY(jn_numbers_reserve(&f->numbers, end));
	JN_TRY(jn_numbers_reserve(&f->product, most));
	JN_TRY(jn_numbers_reserve(&f->vector, (size_t)f->first[f->count]));
	memset(f->numbers.at, 0, end * sizeof *f->numbers.at);
	return JN_OK;
}

static int offset_in(const JnBlockFactor* f, int p, int q) {
	int low = f->start[p], high = f->start[p + 1] - 1;
	while (low < high) {
		const int middle = (low + high) / 2;
		if (f->later.at[middle] < q)
			low = middle + 1;
		else
			high = middle;
	}
	return f->offset[low];
}

JnBlock jn_block_at(JnBlockFactor* f, int row_group, int column_group) {
	const int row = f->place[row_group], column = f->place[column_group];
	double* numbers = f->numbers.at;
	if (row == column) return (JnBlock){numbers + f->diagonal[row], own_count(f, row)};
	if (row > column) return (JnBlock){numbers + f->below[column] + offset_in(f, column, row), later_count(f, column)};
	if (f->is_symmetric) return (JnBlock){NULL, 0};
	const size_t own = (size_t)own_count(f, row);
	return (JnBlock){numbers + f->beside[row] + own * (size_t)offset_in(f, row, column), (int)own};
}

// to -= from
static void subtract(int rows, int columns, const double* from, int from_stride, double* to, int to_stride) {
	for (size_t j = 0; j < (size_t)columns; ++j)
		for (size_t i = 0; i < (size_t)rows; ++i) to[i + j * (size_t)to_stride] -= from[i + j * (size_t)from_stride];
}

// Take the product of p's panels off the blocks of its later groups m and q >= m.
static void subtract_product(JnBlockFactor* f, int p) {
	const int height = later_count(f, p);
	const double* product = f->product.at;
	for (int i = f->start[p]; i < f->start[p + 1]; ++i) {
		const int m = f->later.at[i], at_m = f->offset[i], columns = own_count(f, m), stride = later_count(f, m);
		const double* column = product + (size_t)at_m * (size_t)height;
		subtract(columns, columns, column + at_m, height, f->numbers.at + f->diagonal[m], columns);
		for (int k = f->start[m]; k < f->start[m + 1]; ++k) f->offset_of[f->later.at[k]] = f->offset[k];
		for (int k = i + 1; k < f->start[p + 1]; ++k) {
			const int q = f->later.at[k], at_q = f->offset[k], rows = own_count(f, q), to = f->offset_of[q];
			subtract(rows, columns, column + at_q, height, f->numbers.at + f->below[m] + to, stride);
			if (f->is_symmetric) continue;
			subtract(columns, rows, product + at_m + (size_t)at_q * (size_t)height, height,
					 f->numbers.at + f->beside[m] + (size_t)to * (size_t)columns, columns);
		}
	}
}

static int eliminate_by_cholesky(JnBlockFactor* f, int p) {
	const double one = 1, zero = 0;
	const int own = own_count(f, p), later = later_count(f, p);
	double *diagonal = f->numbers.at + f->diagonal[p], *below = f->numbers.at + f->below[p];
	int info = 0;
	dpotrf_("L", &own, diagonal, &own, &info, 1);
	if (info != 0 || later == 0) return info;
	dtrsm_("R", "L", "T", "N", &later, &own, &one, diagonal, &own, below, &later, 1, 1, 1, 1);
	dsyrk_("L", "N", &later, &own, &one, below, &later, &zero, f->product.at, &later, 1, 1);
	return info;
}

static int eliminate_by_lu(JnBlockFactor* f, int p) {
	const double one = 1, zero = 0;
	const int own = own_count(f, p), later = later_count(f, p);
	double *diagonal = f->numbers.at + f->diagonal[p], *beside = f->numbers.at + f->beside[p];
	int *pivots = f->pivots + f->first[p], info = 0;
	dgetrf_(&own, &own, diagonal, &own, pivots, &info);
	if (info != 0 || later == 0) return info;
	dgetrs_("N", &own, &later, diagonal, &own, pivots, beside, &own, &info, 1);
	dgemm_("N", "N", &later, &later, &own, &one, f->numbers.at + f->below[p], &later, beside, &own, &zero,
		   f->product.at, &later, 1, 1);
	return info;
}

JnStatus jn_block_factorize(JnBlockFactor* f, bool* is_regular) {
	*is_regular = true;
	for (int p = 0; p < f->count && *is_regular; ++p) {
		if (own_count(f, p) == 0) continue;
		*is_regular = (f->is_symmetric ? eliminate_by_cholesky(f, p) : eliminate_by_lu(f, p)) == 0;
		if (*is_regular) subtract_product(f, p);
	}
	return JN_OK;
}

static void forward(JnBlockFactor* f, int p, double* x) {
	const double one = 1, minus = -1;
	const int own = own_count(f, p), later = later_count(f, p), step = 1;
	int info = 0;
	const double *diagonal = f->numbers.at + f->diagonal[p], *below = f->numbers.at + f->below[p];
	double *mine = x + f->first[p], *product = f->vector.at;
	if (f->is_symmetric)
		dtrsm_("L", "L", "N", "N", &own, &step, &one, diagonal, &own, mine, &own, 1, 1, 1, 1);
	else
		dgetrs_("N", &own, &step, diagonal, &own, f->pivots + f->first[p], mine, &own, &info, 1);
	if (later == 0) return;
	memset(product, 0, (size_t)later * sizeof *product);
	dgemv_("N", &later, &own, &minus, below, &later, mine, &step, &one, product, &step, 1);
	for (int k = f->start[p]; k < f->start[p + 1]; ++k)
		for (int i = 0; i < own_count(f, f->later.at[k]); ++i)
			x[f->first[f->later.at[k]] + i] += product[f->offset[k] + i];
}

static void backward(JnBlockFactor* f, int p, double* x) {
	const double one = 1, minus = -1;
	const int own = own_count(f, p), later = later_count(f, p), step = 1;
	double *mine = x + f->first[p], *theirs = f->vector.at;
	for (int k = f->start[p]; k < f->start[p + 1]; ++k)
		memcpy(theirs + f->offset[k], x + f->first[f->later.at[k]],
			   (size_t)own_count(f, f->later.at[k]) * sizeof *theirs);
	if (f->is_symmetric) {
		if (later > 0)
			dgemv_("T", &later, &own, &minus, f->numbers.at + f->below[p], &later, theirs, &step, &one, mine, &step, 1);
		dtrsm_("L", "L", "T", "N", &own, &step, &one, f->numbers.at + f->diagonal[p], &own, mine, &own, 1, 1, 1, 1);
	} else if (later > 0) {
		dgemv_("N", &own, &later, &minus, f->numbers.at + f->beside[p], &own, theirs, &step, &one, mine, &step, 1);
	}
}

void jn_block_solve(JnBlockFactor* f, double* x) {
	for (int p = 0; p < f->count; ++p)
		if (own_count(f, p) > 0) forward(f, p, x);
	for (int p = f->count - 1; p >= 0; --p)
		if (own_count(f, p) > 0) backward(f, p, x);
}
