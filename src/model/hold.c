// A step asks for one time again and again: nothing is evaluated twice.
#include "model/hold.h"

#include <math.h>

JnStatus jn_hold_create(JnModel* model, JnHold* hold) {
	hold->t = NAN;
	JN_NEW(&model->arena, hold->values, model->held_count + 1);
	for (int i = 0; i < model->held_count; ++i) hold->values[i].x = model->rest[model->held_list[i].entry];
	return JN_OK;
}

static void move_inputs(const JnModel* model, double t, JnMotionValue* values) {
	for (int i = 0; i < model->input_count; ++i) {
		const JnInput* input = &model->inputs[i];
		JnMotionValue moved[3];
		jn_input_at(input, t, moved);
		for (int k = 0; k < input->count; ++k) {
			const int entry = model->held_list[input->held[k]].entry;
			values[input->held[k]] = moved[entry % 3];
			values[input->held[k]].x += model->rest[entry];
		}
	}
}

const JnMotionValue* jn_hold_at(const JnModel* model, JnHold* hold, double t) {
	if (hold->t == t) return hold->values;
	for (int i = 0; i < model->held_count; ++i) {
		const JnHeld* held = &model->held_list[i];
		if (held->motion == NULL) continue;
		hold->values[i] = ((const JnMotionType*)held->motion->row)->at(held->motion->options, t);
		hold->values[i].x += model->rest[held->entry];
	}
	for (int i = 0; i < model->guide_count; ++i) jn_guide_at(&model->guides[i], t, hold->values);
	move_inputs(model, t, hold->values);
	hold->t = t;
	return hold->values;
}
