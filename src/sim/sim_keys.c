#include "sim/sim_keys.h"

const JnKey jn_sim_keys[] = {JN_SIM_KEY_ROWS(JnSimDef, ), {0}};
