/// @file pass.h
/// What acts on a step beside the integrator: each kind is a row of the list, and a simulation runs those that its
/// definition asks for.
#ifndef JN_PASS_PASS_H
#define JN_PASS_PASS_H

#include "jounce/sim.h"

enum { JN_PASSES_MOST = 8 };

extern const JnPassType* const jn_pass_list[]; ///< NULL at the end, in the order in which they run
extern const JnPassType jn_pass_contact;
extern const JnPassType jn_pass_collision;
extern const JnPassType jn_pass_suture;
extern const JnPassType jn_pass_fracture;
extern const JnKey jn_contact_keys[];                              ///< of JnContactDef
extern const JnKey jn_collision_keys[];                            ///< of JnCollisionDef
extern const JnKey jn_suture_keys[];                               ///< of JnSutureDef
extern const JnKey jn_fracture_keys[];                             ///< of JnFractureDef
extern const JnPassType jn_pass_relax_before, jn_pass_relax_after; ///< contact
extern const JnKey jn_relax_keys[];                                ///< of JnRelaxDef

/// The passes of a simulation. All zero is valid and does nothing.
typedef struct JnPasses {
	int count;
	JnPass* list[JN_PASSES_MOST];
} JnPasses;

/// Build what `def` asks for. On failure nothing is left; a message says why. Free with jn_passes_destroy.
JnStatus jn_passes_create(const JnSimDef* def, JnModel* model, JnPasses* passes);
void jn_passes_destroy(JnPasses* passes);

/// The verbs of JnPassType for all of them. *edited and *again are true when some pass says so, and false otherwise.
JnStatus jn_passes_prepare(JnPasses* passes, const JnStep* step, int round);
JnStatus jn_passes_correct(JnPasses* passes, JnStep* step, int round, bool* edited, bool* again);
void jn_passes_commit(JnPasses* passes, const JnStep* step);

/// Add what the passes did to held nodes in the last accepted step, beside the loads of the system [N].
void jn_passes_react(const JnPasses* passes, double* force);

/// Write or read what the passes remember.
void jn_passes_archive(JnPasses* passes, JnArchive* archive);

/// The first complaint that a pass has; its cause is "" when none has failed.
void jn_passes_explain(const JnPasses* passes, JnPassComplaint* out);

#endif
