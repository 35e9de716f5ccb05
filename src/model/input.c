// With s = (t - t0) / h, r = 1 - s and the difference d = x1 - x0,
//   x = x0 + d s^2 (3 - 2 s) + h s r (r v0 - s v1)
//   v = 6 s r d / h + r (1 - 3 s) v0 + s (1 - 3 r) v1
//   a = (6 (1 - 2 s) d / h + (6 s - 4) v0 + (6 s - 2) v1) / h
#include "model/input.h"

#include <string.h>

void jn_input_set(JnInput* input, const double displacement[3], const double velocity[3]) {
	memcpy(input->next.x, displacement, sizeof input->next.x);
	if (velocity != NULL) memcpy(input->next.v, velocity, sizeof input->next.v);
	input->has_rate = velocity != NULL;
	input->is_set = true;
}

void jn_input_begin(JnInput* input, double t, double dt) {
	if (!input->is_set) return;
	JnMotionValue now[3];
	jn_input_at(input, t, now);
	input->from.t = t;
	input->to = input->next;
	input->to.t = t + dt;
	for (int a = 0; a < 3; ++a) {
		input->from.x[a] = now[a].x;
		input->from.v[a] = now[a].v;
		if (!input->has_rate) input->to.v[a] = (input->to.x[a] - now[a].x) / dt;
	}
	input->is_set = false;
}

static JnMotionValue between(double x0, double v0, double x1, double v1, double s, double h) {
	const double r = 1 - s, d = x1 - x0;
	return (JnMotionValue){
		.x = x0 + d * s * s * (3 - 2 * s) + h * s * r * (r * v0 - s * v1),
		.v = 6 * s * r * d / h + r * (1 - 3 * s) * v0 + s * (1 - 3 * r) * v1,
		.a = (6 * (1 - 2 * s) * d / h + (6 * s - 4) * v0 + (6 * s - 2) * v1) / h,
	};
}

// Times are sums of steps: a step that ends where the motion does may end a few roundings behind it.
void jn_input_at(const JnInput* input, double t, JnMotionValue out[3]) {
	const JnInputKey *from = &input->from, *to = &input->to;
	const double h = to->t - from->t, slack = 1e-9 * h;
	for (int a = 0; a < 3; ++a) {
		if (t <= from->t - slack || h == 0)
			out[a] = (JnMotionValue){.x = from->x[a]};
		else if (t > to->t + slack)
			out[a] = (JnMotionValue){.x = to->x[a]};
		else
			out[a] = between(from->x[a], from->v[a], to->x[a], to->v[a], (t - from->t) / h, h);
	}
}
