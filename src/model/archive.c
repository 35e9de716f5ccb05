// What changes in a model while it is simulated; all else follows from its definition.
#include "force/bond.h"
#include "model/input.h"
#include "model/model.h"

// Broken bonds, one bit each: such a bond has no force.
static void archive_bonds(JnGroup* group, JnArchive* archive) {
	for (int e = 0; e < group->count; e += 64) {
		const int end = e + 64 < group->count ? e + 64 : group->count;
		uint64_t broken = 0;
		for (int k = e; k < end; ++k) broken |= (uint64_t)(jn_bond_get(group, k).force == 0) << (k - e);
		jn_archive_bytes(archive, "broken", &broken, sizeof broken);
		for (int k = e; archive->is_reading && k < end; ++k) {
			JnBond bond = jn_bond_get(group, k);
			if ((broken >> (k - e) & 1) == 0 || bond.force == 0) continue;
			bond.force = 0;
			jn_bond_set(group, k, &bond);
		}
	}
}

static void archive_input(JnInput* input, JnArchive* archive) {
	jn_archive_bytes(archive, "from", &input->from, sizeof input->from);
	jn_archive_bytes(archive, "to", &input->to, sizeof input->to);
	jn_archive_bytes(archive, "next", &input->next, sizeof input->next);
	jn_archive_switch(archive, "is_set", &input->is_set);
	jn_archive_switch(archive, "has_rate", &input->has_rate);
}

void jn_model_archive(JnModel* model, JnArchive* archive) {
	for (int g = 0; g < model->group_count; ++g)
		if (model->groups[g].kernel->damage != NULL) archive_bonds(&model->groups[g], archive);
	for (int i = 0; i < model->input_count; ++i) archive_input(&model->inputs[i], archive);
}
