// The step controllers that scenes may name: the order here is that of `jounce list`.
#include "control/combined.h"
#include "control/controller.h"
#include "control/embedded.h"
#include "control/fixed.h"
#include "control/force_error.h"
#include "control/speed_limit.h"
#include "control/stable.h"
#include "control/step_doubling.h"
#include "control/stretch_limit.h"
#include "control/zienkiewicz_xie.h"

static const JnRow* const rows[] = {
	&jn_controller_fixed.row,           &jn_controller_force_error.row,   &jn_controller_embedded.row,
	&jn_controller_zienkiewicz_xie.row, &jn_controller_step_doubling.row, &jn_controller_speed_limit.row,
	&jn_controller_stretch_limit.row,   &jn_controller_stable.row,        &jn_controller_combined.row,
};

const JnRowList jn_controller_list = {.noun = "controller", .rows = rows, .count = sizeof rows / sizeof *rows};
