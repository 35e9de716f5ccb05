// jounce list: the rows of the catalogues, with what can be computed about them.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "app.h"
#include "base/key.h"
#include "control/controller.h"
#include "force/kernel.h"
#include "integrate/integrator.h"
#include "integrate/tableau.h"
#include "mesh/generate.h"
#include "solve/solver.h"

static const char help[] =
	"usage: jounce list [integrators|materials|elements|solvers|controllers] [--json]\n\n"
	"Without a word: all of them. Properties of integrators are computed from their coefficients:\n"
	"  solves   implicit solves a step\n"
	"  A, L     A-stable, L-stable      SA  stiffly accurate      R(inf)  limit of the stability function\n"
	"  q, r     phase error ~ (omega dt)^(q+1), amplitude loss ~ (omega dt)^(r+1) a step; - : none";

static const char* yes_no(bool value) {
	return value ? "yes" : "no";
}

static void integrators_text(void) {
	printf("%-18s %5s %6s %6s %3s %3s %3s %9s %2s %2s  %s\n", "integrators", "order", "stages", "solves", "A", "L",
		   "SA", "R(inf)", "q", "r", "");
	for (int i = 0; i < jn_integrator_list.count; ++i) {
		const JnIntegratorType* type = (const JnIntegratorType*)jn_integrator_list.rows[i];
		const JnTableau* table = type->table;
		const JnTableauProperties p = jn_tableau_properties(table);
		printf("%-18s %5d %6d %6d %3s %3s %3s %9.4g %2d ", type->row.name, p.order, table->stages, p.implicit_solves,
			   yes_no(p.a_stable), yes_no(p.l_stable), yes_no(p.stiffly_accurate), p.r_infinity, p.dispersion_order);
		if (p.dissipation_order > 0)
			printf("%2d", p.dissipation_order);
		else
			printf("%2s", "-");
		printf("  %s\n", type->row.doc);
	}
}

static void print_json_text(const char* text) {
	putchar('"');
	for (; *text != '\0'; ++text) {
		if (*text == '"' || *text == '\\') putchar('\\');
		putchar(*text);
	}
	putchar('"');
}

static void integrator_json(const JnIntegratorType* type) {
	const JnTableau* table = type->table;
	const JnTableauProperties p = jn_tableau_properties(table);
	printf("\"order\": %d, \"stages\": %d, \"implicit_solves\": %d, \"a_stable\": %s, \"l_stable\": %s, "
		   "\"stiffly_accurate\": %s, \"first_stage_explicit\": %s, \"stage_order\": %d, \"r_infinity\": %.10g, "
		   "\"dispersion_order\": %d, \"dispersion\": %.8g, \"dissipation_order\": ",
		   p.order, table->stages, p.implicit_solves, p.a_stable ? "true" : "false", p.l_stable ? "true" : "false",
		   p.stiffly_accurate ? "true" : "false", p.first_explicit ? "true" : "false", p.stage_order, p.r_infinity,
		   p.dispersion_order, p.dispersion);
	if (p.dissipation_order > 0)
		printf("%d, \"dissipation\": %.8g, ", p.dissipation_order, p.dissipation);
	else
		printf("null, \"dissipation\": 0, ");
}

static void rows_text(const char* title, const JnRowList* list) {
	printf("%s\n", title);
	for (int i = 0; i < list->count; ++i) printf("  %-22s %s\n", list->rows[i]->name, list->rows[i]->doc);
}

static void elements_text(void) {
	puts("elements");
	for (int i = 0; i < JN_SHAPE_COUNT; ++i)
		printf("  %-22s %d nodes, %d faces\n", jn_shape_info[i].name, jn_shape_info[i].nodes, jn_shape_info[i].faces);
}

typedef struct Catalogue {
	const char* name;
	const JnRowList* list; // NULL: elements
} Catalogue;

static const Catalogue catalogues[] = {
	{"integrators", &jn_integrator_list}, {"materials", &jn_law_list},          {"elements", NULL},
	{"solvers", &jn_solver_list},         {"controllers", &jn_controller_list},
};
enum { CATALOGUES = sizeof catalogues / sizeof *catalogues };

static void print_text(const Catalogue* catalogue) {
	if (catalogue->list == NULL)
		elements_text();
	else if (catalogue->list == &jn_integrator_list)
		integrators_text();
	else
		rows_text(catalogue->name, catalogue->list);
}

static void print_json(const Catalogue* catalogue) {
	const int count = catalogue->list != NULL ? catalogue->list->count : JN_SHAPE_COUNT;
	printf("  \"%s\": [", catalogue->name);
	for (int i = 0; i < count; ++i) {
		printf("%s\n    {\"name\": \"%s\", ", i > 0 ? "," : "",
			   catalogue->list != NULL ? catalogue->list->rows[i]->name : jn_shape_info[i].name);
		if (catalogue->list == NULL) {
			printf("\"nodes\": %d, \"faces\": %d}", jn_shape_info[i].nodes, jn_shape_info[i].faces);
			continue;
		}
		if (catalogue->list == &jn_integrator_list) integrator_json((const JnIntegratorType*)catalogue->list->rows[i]);
		fputs("\"doc\": ", stdout);
		print_json_text(catalogue->list->rows[i]->doc);
		putchar('}');
	}
	fputs("\n  ]", stdout);
}

static const char* catalogue_name(void* context, int index) {
	(void)context;
	return index < CATALOGUES ? catalogues[index].name : NULL;
}

static int print_all(const char* word, bool json) {
	bool found = false;
	if (json) puts("{");
	for (int i = 0; i < CATALOGUES; ++i) {
		if (word != NULL && strcmp(word, catalogues[i].name) != 0) continue;
		if (found) puts(json ? "," : "");
		found = true;
		if (json)
			print_json(&catalogues[i]);
		else
			print_text(&catalogues[i]);
	}
	if (json) puts("\n}");
	return EXIT_DONE;
}

int app_list(int count, char** arguments) {
	const char* word = NULL;
	bool json = false;
	for (int i = 1; i < count; ++i) {
		if (strcmp(arguments[i], "--help") == 0 || strcmp(arguments[i], "-h") == 0) return puts(help), EXIT_DONE;
		if (strcmp(arguments[i], "--json") == 0)
			json = true;
		else if (arguments[i][0] == '-')
			return app_usage_error("list", "there is no option '%s'", arguments[i]);
		else if (word != NULL)
			return app_usage_error("list", "one list at a time, or all of them without a word");
		else
			word = arguments[i];
	}
	bool is_known = word == NULL;
	for (int i = 0; i < CATALOGUES && !is_known; ++i) is_known = strcmp(word, catalogues[i].name) == 0;
	if (is_known) return print_all(word, json);
	const char* near = jn_suggest(word, catalogue_name, NULL);
	if (near != NULL) return app_usage_error("list", "there is no list '%s'; did you mean '%s'", word, near);
	return app_usage_error("list", "there is no list '%s'", word);
}
