// Works are estimated from counts and the rates below; iterations a digit are observed where a way serves, and guessed from
// those of the diagonal blocks where it does not. A change comes when what another way would have saved since the last one
// exceeds what the change costs: never more than about twice as dear as the best way known from the beginning (the argument
// of renting or buying skis), and slow to go back.
#include "solve/choice.h"

#include <math.h>

// Nanoseconds on one core (AMD EPYC with AVX2): of a product a stored block, of vectors a node, of a factor an operation
// and an entry, of a solve with it an entry, of assembly a block, of rotations and of an analysis a node.
static const double product_single = 4.5, product_double = 9, vectors_single = 5, vectors_double = 25;
static const double factor_operation = 0.036, factor_entry = 8, solve_entry = 0.6;
static const double assembly = 75, rotation = 100, analysis = 7000;
static const double call = 2000; // whatever the size

// Directions from a kept tangent converge like a secant method: more solves, of which one in so many needs a new factor as
// long as nothing was observed.
static const double secant_solves = 1.5, first_refresh = 0.1;

static const double memory = 0.8;   // weight of what was observed before, against the latest
static const double typical = 3;    // digits of a solve
static const double hysteresis = 3; // typical solves' worth of regret that a change needs in any case
static const double patience = 4;   // an analysis may cost this share of what was spent before, inverted

static double product(const JnChoice* choice) {
	return choice->blocks * (choice->has_single ? product_single : product_double);
}

static double vectors(const JnChoice* choice) {
	return call + choice->nodes * (choice->has_single ? vectors_single : vectors_double);
}

static void put(JnChoice* choice, JnWay way, JnWayWork work) {
	choice->work[way] = (JnWayWork){.is_allowed = choice->work[way].is_allowed,
									.is_known = true,
									.renew = work.renew,
									.update = work.update,
									.iteration = work.iteration,
									.digit = choice->work[way].digit};
}

void jn_choice_learn(JnChoice* choice, JnWay way, double setup_products, double apply_products) {
	const double setup = setup_products * product(choice);
	const bool is_cheap = way == JN_WAY_PLAIN || way == JN_WAY_BLOCK; // always that of the present matrix
	put(choice, way,
		(JnWayWork){.renew = setup,
					.update = is_cheap ? setup : rotation * choice->nodes,
					.iteration = (1 + apply_products) * product(choice) + vectors(choice)});
}

void jn_choice_learn_factor(JnChoice* choice, double flops, double entries) {
	const double factor = call + assembly * choice->blocks + factor_operation * flops + factor_entry * entries;
	const double solve = call + solve_entry * entries;
	put(choice, JN_WAY_DIRECT, (JnWayWork){.renew = factor, .update = factor, .iteration = solve});
	put(choice, JN_WAY_KEPT,
		(JnWayWork){.renew = factor,
					.update = rotation * choice->nodes,
					.iteration = solve + product(choice) + vectors(choice)});
}

void jn_choice_begin(JnChoice* choice, int nodes, int blocks, bool has_single, const bool allowed[JN_WAY_COUNT]) {
	static const JnWay order[] = {JN_WAY_INCOMPLETE, JN_WAY_BLOCK,     JN_WAY_DIRECT,
								  JN_WAY_KEPT,       JN_WAY_MULTIGRID, JN_WAY_PLAIN};
	*choice = (JnChoice){.nodes = nodes, .blocks = blocks, .has_single = has_single, .refresh = first_refresh};
	for (int i = JN_WAY_COUNT - 1; i >= 0; --i) {
		choice->work[order[i]].is_allowed = allowed[order[i]];
		if (allowed[order[i]]) choice->way = order[i];
	}
	jn_choice_learn(choice, JN_WAY_PLAIN, 0, 0);
	jn_choice_learn(choice, JN_WAY_BLOCK, 1, nodes / (2.0 * blocks));
}

bool jn_choice_wants_to_know(const JnChoice* choice, JnWay way) {
	const JnWayWork* work = &choice->work[way];
	return work->is_allowed && !work->is_known && choice->spent > patience * (call + analysis * choice->nodes);
}

// Iterations a digit that the diagonal blocks take or would take: about four times those of an incomplete factor.
static double digit_of_block(const JnChoice* choice) {
	if (choice->work[JN_WAY_BLOCK].digit > 0) return choice->work[JN_WAY_BLOCK].digit;
	if (choice->work[JN_WAY_INCOMPLETE].digit > 0) return 4 * choice->work[JN_WAY_INCOMPLETE].digit;
	return 10;
}

// Iterations a digit that `way` takes or would take, as measured on cloth, beam, jello and blocks.
static double digit_of(const JnChoice* choice, JnWay way) {
	const double block = digit_of_block(choice);
	const double expected[JN_WAY_COUNT] = {[JN_WAY_PLAIN] = 2 * block,
										   [JN_WAY_BLOCK] = block,
										   [JN_WAY_KEPT] = 1,
										   [JN_WAY_INCOMPLETE] = fmax(0.7, 0.25 * block),
										   [JN_WAY_MULTIGRID] = fmax(1.3, 0.04 * block)};
	return choice->work[way].digit > 0 ? choice->work[way].digit : expected[way];
}

// What `digits` more cost with `way`, its share of matrices included.
static double price(const JnChoice* choice, JnWay way, double digits) {
	const JnWayWork* work = &choice->work[way];
	if (way == JN_WAY_DIRECT)
		return secant_solves * (work->iteration + product(choice) + choice->refresh * work->renew);
	return digits * digit_of(choice, way) * work->iteration + work->update;
}

static double cost_of_change(const JnChoice* choice, JnWay way) {
	return fmax(choice->work[way].renew, hysteresis * price(choice, choice->way, typical));
}

static void change(JnChoice* choice, JnWay way) {
	++choice->changes;
	choice->way = way;
	choice->fresh = choice->excess = choice->best = 0;
	for (int i = 0; i < JN_WAY_COUNT; ++i) choice->regret[i] = 0;
}

JnWay jn_choice_next(JnChoice* choice) {
	JnWay best = choice->way;
	double most = 1;
	for (int way = 0; way < JN_WAY_COUNT; ++way) {
		const JnWayWork* work = &choice->work[way];
		if (!work->is_allowed || !work->is_known || way == (int)choice->way) continue;
		const double share = choice->regret[way] / cost_of_change(choice, (JnWay)way);
		if (share <= most) continue;
		most = share;
		best = (JnWay)way;
	}
	if (best != choice->way) change(choice, best);
	return best;
}

bool jn_choice_renews(const JnChoice* choice) {
	return choice->excess > choice->work[choice->way].renew;
}

void jn_choice_count_matrix(JnChoice* choice, bool is_renewed) {
	const JnWayWork* work = &choice->work[choice->way];
	choice->spent += is_renewed ? work->renew : work->update;
	++choice->matrices;
	if (is_renewed) choice->fresh = choice->excess = 0;
}

// A solve with a factor is one of the secant method's.
static void count_direct(JnChoice* choice) {
	choice->refresh = memory * choice->refresh + (1 - memory) * choice->matrices;
	choice->matrices = 0;
	choice->spent += choice->work[JN_WAY_DIRECT].iteration;
}

// Where the present way has come to take twice the iterations, what others took before says little.
static void forget_others(JnChoice* choice, double digit) {
	if (choice->best == 0 || digit < choice->best) choice->best = digit;
	if (digit <= 2 * choice->best) return;
	for (int way = 0; way < JN_WAY_COUNT; ++way)
		if (way != (int)choice->way) choice->work[way].digit = 0;
	choice->best = digit;
}

static void observe(JnChoice* choice, int iterations, double digits) {
	JnWayWork* work = &choice->work[choice->way];
	const double latest = iterations / digits;
	work->digit = work->digit > 0 ? memory * work->digit + (1 - memory) * latest : latest;
	if (choice->fresh == 0 || latest < choice->fresh) choice->fresh = latest;
	choice->excess += (iterations - digits * choice->fresh) * work->iteration;
	choice->spent += iterations * work->iteration;
	forget_others(choice, work->digit);
}

void jn_choice_count_solve(JnChoice* choice, int iterations, double digits) {
	const bool is_direct = choice->way == JN_WAY_DIRECT;
	if (!is_direct && (iterations == 0 || digits < 0.3)) return;
	if (is_direct)
		count_direct(choice);
	else
		observe(choice, iterations, digits);
	const double share = is_direct ? 1 / secant_solves : 1, wanted = is_direct ? typical : digits;
	const double here = share * price(choice, choice->way, wanted);
	for (int way = 0; way < JN_WAY_COUNT; ++way) {
		if (!choice->work[way].is_known) continue;
		const double saved = here - share * price(choice, (JnWay)way, wanted);
		choice->regret[way] = fmax(0, choice->regret[way] + saved);
	}
}

bool jn_choice_forbid(JnChoice* choice, JnWay way) {
	choice->work[way].is_allowed = false;
	if (way != choice->way) return true;
	static const JnWay strongest_first[] = {JN_WAY_KEPT,       JN_WAY_DIRECT, JN_WAY_MULTIGRID,
											JN_WAY_INCOMPLETE, JN_WAY_BLOCK,  JN_WAY_PLAIN};
	for (int i = 0; i < JN_WAY_COUNT; ++i) {
		if (!choice->work[strongest_first[i]].is_allowed) continue;
		change(choice, strongest_first[i]);
		return true;
	}
	return false;
}
