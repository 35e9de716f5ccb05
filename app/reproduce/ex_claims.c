#include "reproduce/ex_claims.h"

#include <math.h>

const ScoreMethod* ex_method(const Score* score, const char* name) {
	static const ScoreMethod unknown = {.limit = NAN, .seconds = NAN, .forces = NAN, .error_half = NAN};
	const ScoreMethod* found = score_find(score, name);
	return found != NULL ? found : &unknown;
}

static double value(const Score* score, const char* name) {
	return score_value(score, ex_method(score, name));
}

// How many of the methods have a score that is higher by more than a tie.
static int count_above(const Score* score, const char* name) {
	int count = 0;
	for (int i = 0; i < score->count; ++i)
		count += score_value(score, &score->list[i]) > (1 + EX_TIE) * value(score, name);
	return count;
}

static int count_near(const Score* score, const char* name) {
	int count = -1; // itself
	for (int i = 0; i < score->count; ++i)
		count += fabs(score_value(score, &score->list[i]) / value(score, name) - 1) <= EX_TIE;
	return count;
}

// The paper gives `name` a place; places within a tie count as that place.
static void claim_place(Table* table, const Score* score, const char* words, const char* name, int place) {
	const double here = value(score, name);
	const int above = count_above(score, name), near = count_near(score, name);
	const bool holds = above < place && above + near + 1 >= place;
	claims_add(table, words, claim_judge(holds, 1, &here), "score %.3g: %d of %d score more, %d the same within %g %%",
			   here, above, score->count - 1, near, 100 * EX_TIE);
}

static void claim_ratio(Table* table, const Score* score, const char* words, const char* better, const char* worse,
						double least) {
	const double a = ex_method(score, better)->limit, b = ex_method(score, worse)->limit;
	claims_add(table, words, claim_judge(a > least * b, 2, (double[]){a, b}),
			   "largest stable step %.3g ms against %.3g ms: %.2g times", 1e3 * a, 1e3 * b, a / b);
}

static void claim_costly(Table* table, const Score* score) {
	const double here = ex_method(score, "rk4")->seconds, place = value(score, "rk4"),
				 euler = value(score, "symplectic_euler");
	double most = 0, limit = 0;
	for (int i = 0; i < score->count; ++i) {
		most = fmax(most, score->list[i].seconds);
		limit = fmax(limit, score->list[i].limit);
	}
	claims_add(table, "RK4 is the most time consuming", claim_judge(here >= most, 1, &here),
			   "%.3g us a step; the most is %.3g us", 1e6 * here, 1e6 * most);
	claims_add(table, "RK4 supports relatively high time steps",
			   claim_judge(ex_method(score, "rk4")->limit >= limit, 1, &here), "%.3g ms; the largest of all is %.3g ms",
			   1e3 * ex_method(score, "rk4")->limit, 1e3 * limit);
	claims_add(table, "but the cost does not justify them", claim_judge(place < euler, 2, (double[]){place, euler}),
			   "score %.3g against %.3g of symplectic Euler", place, euler);
}

static void claim_accuracy(Table* table, const Score* score, const ExAccuracy* accuracy) {
	const int here = (int)(ex_method(score, "forest_ruth") - score->list);
	int best = here;
	const bool is_known = score_find(score, "forest_ruth") != NULL;
	if (!is_known) return;
	for (int i = 0; i < score->count; ++i)
		if (accuracy[i].error < accuracy[best].error) best = i;
	claims_add(table, "Forest-Ruth is the best alternative where accuracy counts (without damping, at equal cost)",
			   claim_judge(best == here, 1, &accuracy[here].error), "error %.2g m; the least is %.2g m, of %s",
			   accuracy[here].error, accuracy[best].error, score->list[best].type->row.name);
	claims_add(table, "Forest-Ruth is accurate up to the third order",
			   claim_judge(fabs(accuracy[here].order - 3) < 0.5, 1, &accuracy[here].order),
			   "measured order %.2f; it is a method of fourth order", accuracy[here].order);
}

static void claim_energy(Table* table, const Score* undamped) {
	const double kept = ex_method(undamped, "forest_ruth")->error_half, lost = ex_method(undamped, "rk4")->error_half;
	claims_add(table, "Forest-Ruth conserves energy, more so than RK4 (without damping)",
			   claim_judge(fabs(kept) < fabs(lost), 2, (double[]){kept, lost}),
			   "energy error at half the largest stable step %.1e against %.1e", kept, lost);
	claims_add(table, "RK4 progressively loses small amounts of energy", claim_judge(lost < 0, 1, &lost),
			   "energy error %.1e", lost);
}

void ex_claims_add(const Score* score, Table* table) {
	claim_place(table, score, "Symplectic Euler has the highest score", "symplectic_euler", 1);
	claim_place(table, score, "Modified midpoint has the second highest", "modified_midpoint", 2);
	claim_place(table, score, "Verlet comes next", "verlet", 3);
	claim_ratio(table, score,
				"The modification significantly (here: by half or more) increases the stability of the half step",
				"modified_half_step", "half_step", 1.5);
	claim_ratio(table, score, "Symplectic methods outperform explicit ones: Euler", "symplectic_euler",
				"explicit_euler", 1);
	claim_ratio(table, score, "the same for midpoint", "modified_midpoint", "midpoint", 1);
	claim_costly(table, score);
}

void ex_claims_add_accuracy(const Score* undamped, const ExAccuracy* accuracy, Table* table) {
	claim_accuracy(table, undamped, accuracy);
	claim_energy(table, undamped);
}
