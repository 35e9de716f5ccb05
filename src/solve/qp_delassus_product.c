// Products with W, which is a sum over bodies: each reads what its rows need and adds what they get.
#include <string.h>

#include "math/lapack.h"
#include "solve/qp_delassus.h"

void jn_delassus_multiply(JnDelassus* d, const double* x, double* out) {
	const double one = 1, zero = 0;
	const int step = 1;
	memset(out, 0, (size_t)d->slots * sizeof *out);
	for (int b = 0; b < d->body_count; ++b) {
		JnDelassusBody* body = &d->bodies[b];
		const int stride = (int)body->stride;
		if (body->first < 0) continue;
		for (const JnTouch* t = jn_touch_at(d, body->first); t != NULL; t = jn_touch_at(d, t->next))
			for (int a = 0; a < jn_delassus_row_count(d, t->contact); ++a)
				body->lambda[t->local + a] = x[d->start[t->contact] + a];
		dgemv_("N", &body->rows, &body->rows, &one, body->w, &stride, body->lambda, &step, &zero, body->after, &step,
			   1);
		for (const JnTouch* t = jn_touch_at(d, body->first); t != NULL; t = jn_touch_at(d, t->next))
			for (int a = 0; a < jn_delassus_row_count(d, t->contact); ++a)
				out[d->start[t->contact] + a] += body->after[t->local + a];
	}
}

void jn_delassus_velocities(JnDelassus* d) {
	jn_delassus_multiply(d, d->lambda, d->after);
	for (int s = 0; s < d->slots; ++s) d->after[s] += d->before[s];
}

void jn_delassus_block(const JnDelassus* d, int contact, double block[3][3]) {
	const int count = jn_delassus_row_count(d, contact);
	memset(block, 0, 9 * sizeof(double));
	for (int i = d->touch_start[contact]; i < d->touch_start[contact + 1]; ++i) {
		const JnTouch* t = &d->touches[i];
		const JnDelassusBody* body = &d->bodies[t->body];
		for (int column = 0; column < count; ++column)
			for (int row = 0; row < count; ++row)
				block[column][row] += body->w[(size_t)(t->local + column) * body->stride + (size_t)(t->local + row)];
	}
}

void jn_delassus_push(JnDelassus* d, int contact, const double change[3]) {
	const double one = 1;
	const int step = 1, count = jn_delassus_row_count(d, contact);
	for (int i = d->touch_start[contact]; i < d->touch_start[contact + 1]; ++i) {
		const JnTouch* t = &d->touches[i];
		JnDelassusBody* body = &d->bodies[t->body];
		const int stride = (int)body->stride;
		dgemv_("N", &body->rows, &count, &one, body->w + (size_t)t->local * body->stride, &stride, change, &step, &one,
			   body->after, &step, 1);
	}
}

void jn_delassus_collect(JnDelassus* d, int contact) {
	for (int a = 0; a < jn_delassus_row_count(d, contact); ++a) {
		double sum = d->before[d->start[contact] + a];
		for (int i = d->touch_start[contact]; i < d->touch_start[contact + 1]; ++i)
			sum += d->bodies[d->touches[i].body].after[d->touches[i].local + a];
		d->after[d->start[contact] + a] = sum;
	}
}
