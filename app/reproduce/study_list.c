// What can be made again: one line a figure or table.
#include "reproduce/study.h"

const Study* const study_list[] = {
	&study_ho_fig1, &study_ho_fig3,   &study_ho_fig4,  &study_ho_fig5, &study_ho_fig6,  &study_ho_fig7,
	&study_ho_fig8, &study_ho_table1, &study_ad_fig1,  &study_ad_fig2, &study_ad_cloth, &study_adaptive_beam,
	&study_notch,   &study_ex_table,  &study_ex_phase, NULL,
};
