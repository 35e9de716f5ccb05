// What the paper says about phase portraits, judged by the energies of their runs.
#include <math.h>
#include <string.h>

#include "reproduce/ex_phase.h"
#include "reproduce/series.h"

static ExDrift drift_of(const Series* series, int total) {
	ExDrift drift = {0};
	const double first = series->values[total];
	int count = 0;
	for (int row = 1; row < series->rows; ++row) {
		const double change = series->values[row * series->columns + total] / first - 1;
		drift.largest = fmax(drift.largest, fabs(change));
		if (row < 4 * series->rows / 5) continue;
		drift.end += change;
		++count;
	}
	drift.end /= count;
	return drift;
}

static JnStatus read_drift(const StudyRun* run, int index, ExDrift* drift) {
	Series series;
	int total = 0;
	JnStatus status = series_read(study_folder(run, index), "series.csv", &series);
	if (status == JN_OK) status = series_column(&series, "total", &total);
	if (status == JN_OK) *drift = drift_of(&series, total);
	series_free(&series);
	return status;
}

JnStatus ex_find_drift(const StudyRun* run, const ExPortrait* portrait, const char* method, ExDrift* out) {
	int count = 0;
	*out = (ExDrift){0};
	for (int s = 0; s < EX_STARTS; ++s) {
		char name[96];
		ExDrift one = {NAN, NAN};
		ex_name_case(portrait, method, s, name);
		const int index = study_find(run, name);
		if (index < 0) continue;
		if (study_is_done(run, index)) JN_TRY(read_drift(run, index, &one));
		out->largest = one.largest > out->largest || isnan(one.largest) ? one.largest : out->largest;
		out->end += one.end;
		++count;
	}
	out->end /= count; // NAN without any
	if (count == 0) out->largest = NAN;
	return JN_OK;
}

// ---- what the paper says ----

static ExDrift drift_named(const StudyRun* run, const char* portrait, const char* method) {
	ExDrift drift = {NAN, NAN};
	for (int p = 0; p < EX_PORTRAITS; ++p)
		if (strcmp(ex_portraits[p].name, portrait) == 0 &&
			ex_find_drift(run, &ex_portraits[p], method, &drift) != JN_OK)
			return (ExDrift){NAN, NAN};
	return drift;
}

/// Two methods of a picture, one of which has the smaller errors of energy.
typedef struct Order {
	const char *words, *portrait, *better, *worse;
} Order;

static const Order orders[] = {
	{"The explicit Euler is clearly the most unstable, beside midpoint", "explicit", "midpoint", "explicit_euler"},
	{"Modified midpoint has slightly lower energy variations than symplectic Euler", "symplectic", "modified_midpoint",
	 "symplectic_euler"},
	{"The modified half step is more stable than the original", "half_steps", "modified_half_step", "half_step"},
	{"Without damping Verlet is a natural choice, beside symplectic Euler", "energy_keepers", "verlet",
	 "symplectic_euler"},
	{"and Forest-Ruth, beside Verlet", "energy_keepers", "forest_ruth", "verlet"},
	{"Both half steps are much more stable than explicit Euler (the original here)", "all", "half_step",
	 "explicit_euler"},
};

static void add_orders(const StudyRun* run, Table* table) {
	for (size_t i = 0; i < sizeof orders / sizeof *orders; ++i) {
		const Order* order = &orders[i];
		const double a = drift_named(run, order->portrait, order->better).largest,
					 b = drift_named(run, order->portrait, order->worse).largest;
		claims_add(table, order->words, claim_judge(a < b, 2, (double[]){a, b}),
				   "largest error of energy %.2g (%s) against %.2g (%s)", a, order->better, b, order->worse);
	}
}

/// A method whose energy grows or falls.
typedef struct Trend {
	const char *words, *portrait, *method;
	int sign;
} Trend;

static const Trend trends[] = {
	{"The half step adds energy", "half_steps", "half_step", 1},
	{"The modified half step adds energy", "half_steps", "modified_half_step", 1},
	{"RK4 progressively loses small amounts of energy", "all", "rk4", -1},
};

static void add_trends(const StudyRun* run, Table* table) {
	for (size_t i = 0; i < sizeof trends / sizeof *trends; ++i) {
		const double end = drift_named(run, trends[i].portrait, trends[i].method).end;
		claims_add(table, trends[i].words, claim_judge(end * trends[i].sign > 0, 1, &end),
				   "energy over the last fifth of the time: %+.2g of that at the start", end);
	}
}

void ex_phase_claims(const StudyRun* run, Table* table) {
	add_orders(run, table);
	add_trends(run, table);
}
