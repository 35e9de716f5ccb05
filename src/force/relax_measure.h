/// @file relax_measure.h
/// Measures of relaxation: C of the edges from an element's last node, its gradient by all nodes but the last, and the size
/// at rest that makes a strain of it. See relax.h for the numbers at rest.
#ifndef JN_FORCE_RELAX_MEASURE_H
#define JN_FORCE_RELAX_MEASURE_H

#include "math/mat3.h"

static const double RELAX_LEAST = 1e-150; // [m]: nodes at one place have no direction to part in

// The length of d, and its direction, which is 0 where d is.
JN_INLINE Wide measure_length(const Wide d[3], Wide e[3]) {
	const Wide length = wide_max(wide_sqrt(wide_dot3(d[0], d[0], d[1], d[1], d[2], d[2])), wide_set(RELAX_LEAST));
	JN_UNROLL for (int a = 0; a < 3; a++) e[a] = d[a] / length;
	return length;
}

JN_INLINE Wide spring_measure(const double* rest, Wide edges[][3], Wide gradient[][3], Wide* size) {
	*size = wide_load(rest);
	return measure_length(edges[0], gradient[0]) - *size;
}

JN_INLINE Wide axis_measure(const double* rest, Wide edges[][3], Wide gradient[][3], Wide* size) {
	Wide w[3], d[3], e[3];
	JN_UNROLL for (int i = 0; i < 3; i++) w[i] = wide_load(rest + i * JN_WIDE);
	JN_UNROLL for (int a = 0; a < 3; a++) {
		d[a] = wide_set(0);
		JN_UNROLL for (int i = 0; i < 3; i++) d[a] += w[i] * ((i < 2 ? edges[3 + i][a] : wide_set(0)) - edges[i][a]);
	}
	*size = wide_load(rest + 3 * JN_WIDE);
	const Wide C = measure_length(d, e) - *size;
	JN_UNROLL for (int i = 0; i < 5; i++) {
		JN_UNROLL for (int a = 0; a < 3; a++) gradient[i][a] = i < 3 ? -w[i] * e[a] : w[i - 3] * e[a];
	}
	return C;
}

JN_INLINE Wide volume_measure(const double* rest, Wide edges[][3], Wide gradient[][3], Wide* size) {
	JN_UNROLL for (int i = 0; i < 3; i++) {
		const Wide *p = edges[(i + 1) % 3], *q = edges[(i + 2) % 3];
		JN_UNROLL for (int a = 0; a < 3; a++) {
			const int b = (a + 1) % 3, c = (a + 2) % 3;
			gradient[i][a] = (p[b] * q[c] - p[c] * q[b]) * (1.0 / 6);
		}
	}
	const Wide* d = edges[0];
	*size = wide_load(rest);
	return wide_dot3(d[0], gradient[0][0], d[1], gradient[0][1], d[2], gradient[0][2]) - *size;
}

#endif
