/// @file study.h
/// A figure or table of a paper that `jounce reproduce` makes again: the runs it needs, and the page beside the
/// paper's.
#ifndef JN_APP_REPRODUCE_STUDY_H
#define JN_APP_REPRODUCE_STUDY_H

#include "compare_jobs.h"
#include "reproduce/page.h"

typedef struct ReproduceOptions {
	const char* directory; ///< -o; a folder for each study is made below it
	const char* scenes;    ///< --scenes: where the scene files are
	int jobs;              ///< --jobs: runs at a time; 0: as many as keep the processors busy
	int threads;           ///< --threads of each run
	bool is_quick;         ///< --quick: smaller and shorter
	bool is_quiet, wants_help;
	int name_count;
	const char** names; ///< of the studies
} ReproduceOptions;

typedef struct Study Study;

/// A study while it is carried out.
typedef struct StudyRun {
	const Study* study;
	const ReproduceOptions* options;
	CompareOptions job_options;
	ComparePlan plan; ///< its runs are the cases; its directory is the study's
	CompareJobs jobs;
	JnStatus status; ///< the first failure while cases were added
} StudyRun;

struct Study {
	const char* name;                                 ///< "ho-fig3"
	const char* doc;                                  ///< one line
	const char* shown;                                ///< what the paper shows there, in sentences
	bool is_timed;                                    ///< its wall times count, so that the cases run one at a time
	JnStatus (*plan)(StudyRun* run);                  ///< add the cases
	void (*ended)(const CompareJob* job, void* user); ///< what to do with a case that is newly done; NULL: nothing
	JnStatus (*report)(StudyRun* run, Page* page);    ///< tables, pictures and words from what the cases left
};

extern const Study study_ho_fig1, study_ho_fig3, study_ho_fig4, study_ho_fig5, study_ho_fig6, study_ho_fig7,
	study_ho_fig8, study_ho_table1, study_ad_fig1, study_ad_fig2, study_ad_cloth, study_adaptive_beam, study_notch,
	study_ex_phase, study_ex_table;
extern const Study* const study_list[]; ///< all of these, and NULL at the end

/// Add a case: `scene` is a file in the folder of scenes, `name` its folder, `label` for people, `steps` what it costs.
CompareRun* study_add(StudyRun* run, const char* scene, const char* name, const char* label, double steps);

/// Override a key of the last case: study_set(run, "step.dt=%g ms", 5.0).
void study_set(StudyRun* run, const char* format, ...) __attribute__((format(printf, 2, 3)));

/// Add `_name` to the name and `, label` to the label of the last case, a variant of another.
void study_extend(StudyRun* run, const char* name, const char* label);

/// A failure of the last case is no failure of the study, but one of its findings.
void study_allow_failure(StudyRun* run);

/// Index of a case by its name, or -1.
int study_find(const StudyRun* run, const char* name);
/// Is the case done, so that its folder has a whole recording? Negative: no.
bool study_is_done(const StudyRun* run, int index);
/// The folder of a case.
const char* study_folder(const StudyRun* run, int index);
/// A number of the case's summary.json; NAN when the case is not done.
double study_number(const StudyRun* run, int index, const char* name);

/// Carry a study out. `*failed` is the number of cases that failed, `*was_stopped` whether Ctrl-C ended it early.
JnStatus study_carry_out(const Study* study, const ReproduceOptions* options, int* failed, bool* was_stopped);

#endif
