// Writes the page of measured orders: every integrator of the list on the problems of test/table/order_problems.h, by the
// sweep that the tests run.
//
// usage: order_page FOLDER      writes FOLDER/orders.md
#include "table/order_sweep.h"

typedef struct Page {
	OrderResult results[ORDER_PROBLEM_COUNT][ORDER_MOST_METHODS];
	const char* notes[ORDER_EXCEPTION_COUNT]; // reasons in order of appearance
	int note_count;
} Page;

static const char introduction[] =
	"# Measured orders\n\n"
	"Written by `./dev docs`, by the sweep that the tests run (`test/table/order_test.c`); do not edit. The tests fail "
	"when a method\nmisses its **order**, or the other one that a note explains, by more than 0.1.\n\n";

static const char method_of_measuring[] =
	"\n## How it is measured\n\n"
	"The error E(h) is the distance in (x, duration · v) from a reference, `esdirk436` at far smaller steps, when the "
	"problem ends.\nA method may be made for a small leading term, and then the ratio of two errors shows the order of "
	"the "
	"next one. So the\nleading term is singled out first: with E(h) = C h^p + C' h^(p+1) + ...,\n\n"
	"    D(h) = 2^(p+1) E(h/2) - E(h) = C h^p + O(h^(p+2)),    order = log2 |D(h)| / |D(h/2)|\n\n"
	"for three sizes, each half of the one before. A method of order p - 1 shows p - 1 here, and one of order p + 1 "
	"shows "
	"p + 2.\nNewton solves stages to 1e-12; options of methods have their defaults. Steps at the largest size, by the "
	"order "
	"expected:\n\n"
	"| problem | 1 | 2 | 3 | 4 | reference |\n|---|---|---|---|---|---|\n";

static int note_number(Page* page, const char* reason) {
	for (int i = 0; i < page->note_count; ++i)
		if (page->notes[i] == reason || strcmp(page->notes[i], reason) == 0) return i + 1;
	page->notes[page->note_count++] = reason;
	return page->note_count;
}

static void write_method(Page* page, int row, FILE* out) {
	const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[row];
	const bool is_diagonal = page->results[0][row].mass == ORDER_MASS_DIAGONAL;
	fprintf(out, "| `%s`%s | %d |", type->row.name, is_diagonal ? " <sup>d</sup>" : "", type->order);
	for (int p = 0; p < ORDER_PROBLEM_COUNT; ++p) {
		const OrderResult* r = &page->results[p][row];
		if (r->expected == ORDER_EXACT)
			fputs(" exact", out);
		else
			fprintf(out, " %.2f", r->measured);
		if (r->exception != NULL) fprintf(out, " <sup>%d</sup>", note_number(page, r->exception->reason));
		fputs(" |", out);
	}
	fputc('\n', out);
}

static void write_table(Page* page, FILE* out) {
	fputs("| method | order |", out);
	for (int p = 0; p < ORDER_PROBLEM_COUNT; ++p) fprintf(out, " %s |", order_problems[p].name);
	fputs("\n|---|---|", out);
	for (int p = 0; p < ORDER_PROBLEM_COUNT; ++p) fputs("---|", out);
	fputc('\n', out);
	for (int i = 0; i < jn_integrator_list.count; ++i) write_method(page, i, out);
	fputs("\n<sup>d</sup> Explicit: it asks for a diagonal mass and refuses any other. Measured with M = diag(2, 1) on "
		  "the "
		  "pair, with\n`mass: lumped` on the solids.\n",
		  out);
	for (int i = 0; i < page->note_count; ++i) fprintf(out, "\n<sup>%d</sup> %s\n", i + 1, page->notes[i]);
}

static void write_page(Page* page, FILE* out) {
	fputs(introduction, out);
	write_table(page, out);
	fputs("\n## The problems\n\n", out);
	for (int p = 0; p < ORDER_PROBLEM_COUNT; ++p)
		fprintf(out, "- **%s**: %s.\n", order_problems[p].name, order_problems[p].text);
	fputs(method_of_measuring, out);
	for (int p = 0; p < ORDER_PROBLEM_COUNT; ++p) {
		const OrderProblem* problem = &order_problems[p];
		fprintf(out, "| %s |", problem->name);
		for (int order = 1; order <= 4; ++order) fprintf(out, " %d |", problem->coarsest[order - 1]);
		fprintf(out, " %d |\n", problem->reference);
	}
}

// The page says what the tests prove: it is not written when they would fail.
static int misses(const OrderResult results[]) {
	int count = 0;
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		if (order_is_met(&results[i])) continue;
		fprintf(stderr, "order_page: %s has order %.3f and error %.2e where order %d is expected\n",
				results[i].type->row.name, results[i].measured, results[i].error, results[i].expected);
		++count;
	}
	return count;
}

int main(int count, char** arguments) {
	static Page page;
	char path[1024];
	if (count != 2) return fputs("usage: order_page FOLDER\n", stderr), 2;
	for (int p = 0; p < ORDER_PROBLEM_COUNT; ++p)
		if (order_sweep(&order_problems[p], page.results[p]) != JN_OK || misses(page.results[p]) > 0) return 1;
	snprintf(path, sizeof path, "%s/orders.md", arguments[1]);
	FILE* out = fopen(path, "w");
	if (out == NULL) return perror(path), 3;
	write_page(&page, out);
	if (fclose(out) != 0) return perror(path), 3;
	return 0;
}
