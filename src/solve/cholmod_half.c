// The forward substitution of many sparse right-hand sides at once, multifrontal: supernodes from the leaves to the root,
// each with the right-hand sides that reach it alone. With the rows of supernode s split into its own columns (1) and those
// below (2), its front F holds the right-hand sides in rows 1 and what its children have left for both,
//
//   h_1 = L_11^-1 F_1      a piece of the halves
//   F_2 - L_21 h_1         left for the parent, on a stack
//
// The rows of a child are among those of its parent, the supernode of its first row below.
#include "solve/cholmod_half.h"

#include <string.h>

#include "math/lapack.h"

// What a supernode has left for its parent: numbers on the stack, for the columns of its piece.
struct JnHalfLeft {
	size_t column, value; // where those columns begin in out->column, and the numbers on the stack
	int count;            // of columns
	int next;             // supernode with the same parent, or -1
};

typedef struct Forward {
	const cholmod_factor* factor;
	const int *super, *pi, *rows, *position;
	const JnColumns* columns;
	JnHalf* out;
	int *super_of, *place;             // of a row: its supernode, its row within the front
	int *owned, *by_super, *column_of; // entries sorted by supernodes: where those of one begin; column of an entry
	int* local;                        // of a column: its place within the front, or -1
	int* child;                        // of a supernode: the last one that has left something for it, or -1
	size_t top;                        // of the stack
} Forward;

static int own_count(const Forward* f, int s) {
	return f->super[s + 1] - f->super[s];
}

static int row_count(const Forward* f, int s) {
	return f->pi[s + 1] - f->pi[s];
}

static JnStatus reserve(Forward* f) {
	const size_t n = f->factor->n, supernodes = f->factor->nsuper, columns = (size_t)f->columns->count;
	const size_t entries = (size_t)f->columns->start[columns];
	JnHalf* out = f->out;
	JN_TRY(jn_half_begin(out, (int)supernodes));
	JN_TRY(jn_grow((void**)&out->marks, &out->marks_capacity, 2 * n + 2 * supernodes + 2 + 2 * entries + columns,
				   sizeof *out->marks));
	JN_TRY(jn_grow((void**)&out->left, &out->left_capacity, supernodes, sizeof *out->left));
	f->super_of = out->marks;
	f->place = f->super_of + n;
	f->child = f->place + n;
	f->owned = f->child + supernodes;
	f->by_super = f->owned + supernodes + 2;
	f->column_of = f->by_super + entries;
	f->local = f->column_of + entries;
	for (size_t s = 0; s < supernodes; ++s) {
		f->child[s] = -1;
		for (int row = f->super[s]; row < f->super[s + 1]; ++row) f->super_of[row] = (int)s;
	}
	for (size_t column = 0; column < columns; ++column) f->local[column] = -1;
	return JN_OK;
}

// Entries of the right-hand sides by the supernodes that own them; held ones are dropped.
static void sort_entries(Forward* f) {
	const JnColumns* columns = f->columns;
	const int supernodes = (int)f->factor->nsuper;
	int* owned = f->owned + 1; // one ahead while counting, so that filling leaves the beginnings
	memset(f->owned, 0, ((size_t)supernodes + 2) * sizeof *f->owned);
	for (int k = 0; k < columns->start[columns->count]; ++k) {
		const int row = f->position[columns->entry[k]];
		if (row >= 0) ++owned[f->super_of[row] + 1];
	}
	for (int s = 0; s < supernodes; ++s) owned[s + 1] += owned[s];
	for (int column = 0; column < columns->count; ++column)
		for (int k = columns->start[column]; k < columns->start[column + 1]; ++k) {
			const int row = f->position[columns->entry[k]];
			f->column_of[k] = column;
			if (row >= 0) f->by_super[owned[f->super_of[row]]++] = k;
		}
}

// Mark the columns that reach a supernode, and count them.
static int mark_columns(Forward* f, int s) {
	int count = 0;
	for (int k = f->owned[s]; k < f->owned[s + 1]; ++k) {
		int* local = &f->local[f->column_of[f->by_super[k]]];
		count += *local < 0;
		*local = 0;
	}
	for (int c = f->child[s]; c >= 0; c = f->out->left[c].next)
		for (int j = 0; j < f->out->left[c].count; ++j) {
			int* local = &f->local[f->out->column[f->out->left[c].column + (size_t)j] - f->out->count];
			count += *local < 0;
			*local = 0;
		}
	return count;
}

// Ascending places for the marked columns, which are written to the piece.
static void number_columns(Forward* f, const JnHalfPiece* piece) {
	int count = 0;
	for (int column = 0; count < piece->count; ++column) {
		if (f->local[column] < 0) continue;
		f->local[column] = count;
		f->out->column[piece->column + (size_t)count++] = f->out->count + column;
	}
}

static void unmark_columns(Forward* f, const JnHalfPiece* piece) {
	for (int j = 0; j < piece->count; ++j) f->local[f->out->column[piece->column + (size_t)j] - f->out->count] = -1;
}

static void add_entries(Forward* f, int s) {
	const int rows = row_count(f, s);
	for (int k = f->owned[s]; k < f->owned[s + 1]; ++k) {
		const int e = f->by_super[k], row = f->position[f->columns->entry[e]] - f->super[s];
		f->out->front[(size_t)f->local[f->column_of[e]] * (size_t)rows + (size_t)row] += f->columns->value[e];
	}
}

static void add_child(Forward* f, int s, int c) {
	const JnHalfLeft* left = &f->out->left[c];
	const int own = own_count(f, c), below = row_count(f, c) - own;
	const int* row = f->rows + f->pi[c] + own;
	for (int j = 0; j < left->count; ++j) {
		const int local = f->local[f->out->column[left->column + (size_t)j] - f->out->count];
		double* to = f->out->front + (size_t)local * (size_t)row_count(f, s);
		const double* from = f->out->stack + left->value + (size_t)j * (size_t)below;
		for (int i = 0; i < below; ++i) to[f->place[row[i]]] += from[i];
	}
	if (left->value + (size_t)below * (size_t)left->count == f->top) f->top = left->value;
}

static JnStatus assemble(Forward* f, int s, int count) {
	const size_t numbers = (size_t)row_count(f, s) * (size_t)count;
	JN_TRY(jn_grow((void**)&f->out->front, &f->out->front_capacity, numbers, sizeof *f->out->front));
	memset(f->out->front, 0, numbers * sizeof *f->out->front);
	for (int k = 0; k < row_count(f, s); ++k) f->place[f->rows[f->pi[s] + k]] = k;
	add_entries(f, s);
	for (int c = f->child[s]; c >= 0; c = f->out->left[c].next) add_child(f, s, c);
	return JN_OK;
}

static void eliminate(Forward* f, int s, const JnHalfPiece* piece) {
	const double one = 1, minus = -1;
	const int rows = row_count(f, s), own = own_count(f, s), below = rows - own;
	const double* panel = (const double*)f->factor->x + ((const int*)f->factor->px)[s];
	double* front = f->out->front;
	dtrsm_("L", "L", "N", "N", &own, &piece->count, &one, panel, &rows, front, &rows, 1, 1, 1, 1);
	if (below > 0)
		dgemm_("N", "N", &below, &piece->count, &own, &minus, panel + own, &rows, front, &rows, &one, front + own,
			   &rows, 1, 1);
	for (size_t j = 0; j < (size_t)piece->count; ++j)
		memcpy(f->out->value + piece->value + j * (size_t)own, front + j * (size_t)rows, (size_t)own * sizeof *front);
}

static JnStatus leave(Forward* f, int s, const JnHalfPiece* piece) {
	const int rows = row_count(f, s), own = own_count(f, s);
	if (rows == own) return JN_OK;
	const size_t below = (size_t)(rows - own);
	JnHalf* out = f->out;
	JN_TRY(
		jn_grow((void**)&out->stack, &out->stack_capacity, f->top + below * (size_t)piece->count, sizeof *out->stack));
	for (size_t j = 0; j < (size_t)piece->count; ++j)
		memcpy(out->stack + f->top + j * below, out->front + j * (size_t)rows + own, below * sizeof *out->stack);
	const int parent = f->super_of[f->rows[f->pi[s] + own]];
	out->left[s] = (JnHalfLeft){piece->column, f->top, piece->count, f->child[parent]};
	f->child[parent] = s;
	f->top += below * (size_t)piece->count;
	return JN_OK;
}

static JnStatus visit(Forward* f, int s) {
	const int count = mark_columns(f, s);
	if (count == 0) return JN_OK;
	JnHalfPiece* piece;
	JN_TRY(jn_half_append(f->out, s, own_count(f, s), count, &piece));
	number_columns(f, piece);
	JN_TRY(assemble(f, s, count));
	eliminate(f, s, piece);
	unmark_columns(f, piece);
	return leave(f, s, piece);
}

JnStatus jn_cholmod_half(const cholmod_factor* factor, const int* position, const JnColumns* columns, JnHalf* out) {
	Forward f = {.factor = factor,
				 .super = factor->super,
				 .pi = factor->pi,
				 .rows = factor->s,
				 .position = position,
				 .columns = columns,
				 .out = out};
	JN_TRY(reserve(&f));
	sort_entries(&f);
	for (int s = 0; s < (int)factor->nsuper; ++s) JN_TRY(visit(&f, s));
	out->count += columns->count;
	return JN_OK;
}
