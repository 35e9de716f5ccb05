// jounce list: the rows of the catalogues, with what can be computed about them.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "app.h"
#include "base/key.h"
#include "control/controller.h"
#include "detect/obstacle.h"
#include "force/kernel.h"
#include "integrate/integrator.h"
#include "integrate/properties.h"
#include "mesh/shape/path.h"
#include "mesh/shape/shape.h"
#include "model/motion.h"
#include "model/system_list.h"
#include "solve/qp.h"
#include "solve/solver.h"

static const char help[] =
	"usage: jounce list [integrators|materials|shapes|elements|obstacles|curves|motions|solvers|contact_solvers|\n"
	"                    controllers|systems] [--json]\n\n"
	"Without a word: all of them. Properties of integrators follow from their coefficients, or are measured on an\n"
	"undamped oscillator:\n"
	"  solves   linear or nonlinear systems a step     A, L    A-stable, L-stable     SA  stiffly accurate\n"
	"  R(inf)   amplification of infinitely fast oscillations a step\n"
	"  limit    largest stable omega dt of a method that is not A-stable; 0: unstable without damping\n"
	"  q, r     phase error ~ (omega dt)^(q+1), amplitude loss ~ (omega dt)^(r+1) a step; - : none";

static const char* yes_no(bool value) {
	return value ? "yes" : "no";
}

// Rounding leaves -0 and 1e-17 where a limit is 0.
static double tidy(double value) {
	return fabs(value) < 1e-12 ? 0 : value;
}

// A count, or - where there is none.
static void print_count(int width, int count) {
	if (count > 0)
		printf("%*d ", width, count);
	else
		printf("%*s ", width, "-");
}

static void integrator_text(const JnIntegratorType* type) {
	JnIntegratorProperties p;
	jn_integrator_properties(type, &p);
	printf("%-22s %5d ", type->row.name, p.order);
	print_count(6, p.stages);
	printf("%6d %3s %3s %3s ", p.solves, yes_no(p.a_stable), yes_no(p.l_stable), yes_no(p.stiffly_accurate));
	if (isfinite(p.r_infinity))
		printf("%8.4g %6s ", tidy(p.r_infinity), "-");
	else
		printf("%8s %6.4g ", "-", p.stability_limit);
	print_count(2, p.dispersion_order);
	print_count(2, p.dissipation_order);
	printf(" %s\n", type->row.doc);
}

static void integrators_text(void) {
	printf("%-22s %5s %6s %6s %3s %3s %3s %8s %6s %2s %2s\n", "integrators", "order", "stages", "solves", "A", "L",
		   "SA", "R(inf)", "limit", "q", "r");
	for (int i = 0; i < jn_integrator_list.count; ++i)
		integrator_text((const JnIntegratorType*)jn_integrator_list.rows[i]);
}

static void print_json_text(const char* text) {
	putchar('"');
	for (; *text != '\0'; ++text) {
		if (*text == '"' || *text == '\\') putchar('\\');
		putchar(*text);
	}
	putchar('"');
}

static const char* true_false(bool value) {
	return value ? "true" : "false";
}

// JSON has no infinity.
static void json_number(const char* name, double value) {
	if (isfinite(value))
		printf("\"%s\": %.10g, ", name, tidy(value));
	else
		printf("\"%s\": null, ", name);
}

static void integrator_json(const JnIntegratorType* type) {
	JnIntegratorProperties p;
	jn_integrator_properties(type, &p);
	printf("\"order\": %d, \"stages\": %d, \"solves\": %d, \"a_stable\": %s, \"l_stable\": %s, "
		   "\"stiffly_accurate\": %s, \"measured\": %s, \"dispersion_order\": %d, \"dissipation_order\": %d, ",
		   p.order, p.stages, p.solves, true_false(p.a_stable), true_false(p.l_stable), true_false(p.stiffly_accurate),
		   true_false(p.is_measured), p.dispersion_order, p.dissipation_order);
	json_number("dispersion", p.dispersion);
	json_number("dissipation", p.dissipation);
	json_number("r_infinity", p.r_infinity);
	json_number("stability_limit", p.stability_limit);
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
	{"integrators", &jn_integrator_list}, {"materials", &jn_law_list},
	{"shapes", &jn_shape_list},           {"elements", NULL},
	{"obstacles", &jn_obstacle_list},     {"curves", &jn_path_list},
	{"motions", &jn_motion_list},         {"solvers", &jn_solver_list},
	{"contact_solvers", &jn_qp_list},     {"controllers", &jn_controller_list},
	{"systems", &jn_system_list},
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

static int print_lists(const char* word, bool json) {
	bool found = false;
	if (json) puts("{");
	for (int i = 0; i < CATALOGUES; ++i) {
		if (word != NULL && strcmp(word, catalogues[i].name) != 0) continue;
		if (found) puts(json ? "," : "");
		found = true;
		(json ? print_json : print_text)(&catalogues[i]);
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
			return app_usage_error("list", "one list at a time; '%s' is one too many", arguments[i]);
		else
			word = arguments[i];
	}
	bool is_known = word == NULL;
	for (int i = 0; i < CATALOGUES && !is_known; ++i) is_known = strcmp(word, catalogues[i].name) == 0;
	if (is_known) return print_lists(word, json);
	const char* near = jn_suggest(word, catalogue_name, NULL);
	if (near != NULL) return app_usage_error("list", "there is no list '%s'; did you mean '%s'?", word, near);
	return app_usage_error("list", "there is no list '%s'", word);
}
