#include "mesh/shape/shape_keys.h"

const char* const jn_element_names[] = {[JN_TET4] = "tet4", [JN_TET10] = "tet10", [JN_HEX8] = "hex8", NULL};
const char* const jn_axis_names[] = {"x", "y", "z", NULL};
