// The built-in systems that scenes may name.
#include "model/system_list.h"

#include "model/pendulum.h"
#include "model/spring_1d.h"

static const JnRow* const rows[] = {&jn_system_spring_1d.row, &jn_system_pendulum.row};

const JnRowList jn_system_list = {.noun = "system", .rows = rows, .count = sizeof rows / sizeof *rows};
