#include "export_look.h"

#include <string.h>

// Okabe and Ito's colours that people with any colour vision tell apart, as linear light.
static const double palette[][3] = {{0.791, 0.347, 0.0},   {0.093, 0.456, 0.815}, {0.0, 0.342, 0.171},
									{0.604, 0.191, 0.386}, {0.871, 0.775, 0.054}, {0.0, 0.168, 0.445},
									{0.665, 0.112, 0.0}};
static const double grey[3] = {0.4, 0.4, 0.4};

const double* export_look_color(const Export* export, int part) {
	return export->parts[part].fixed != NULL ? grey : palette[(size_t)part % (sizeof palette / sizeof *palette)];
}

void export_look_upright(const Export* export, double quaternion[4]) {
	static const double half = 0.70710678118654752440;
	// a quarter turn about z or x, none or half a turn about x
	static const double turns[2][3][4] = {{{0, 0, half, half}, {0, 0, 0, 1}, {-half, 0, 0, half}},
										  {{0, 0, -half, half}, {1, 0, 0, 0}, {half, 0, 0, half}}};
	bool is_down;
	const int up = recording_up(&export->recording, &is_down);
	memcpy(quaternion, turns[is_down][up], 4 * sizeof *quaternion);
}
