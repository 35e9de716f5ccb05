// Writes the reference page of the integrators and its pictures from the rows of the list: properties, coefficients and the
// region of stability, measured on the damped oscillator by the code that steps models.
//
// usage: integrator_pages FOLDER      writes FOLDER/integrators.md and FOLDER/integrators/<method>.png (needs gnuplot)
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "integrate/integrator.h"
#include "integrate/properties.h"
#include "integrate/tableau.h"

enum { COLUMNS = 120, ROWS = 80 };

static const double left = -8, right = 4, top = 8; // the part of the complex plane that is shown

static void print_number(FILE* out, double value) {
	if (fabs(value) < 1e-12) value = 0;
	if (isfinite(value))
		fprintf(out, "%.4g", value);
	else
		fputs("–", out);
}

static void print_count(FILE* out, int count) {
	if (count > 0)
		fprintf(out, "%d", count);
	else
		fputs("–", out);
}

static void table_row(FILE* out, const JnIntegratorType* type) {
	JnIntegratorProperties p;
	jn_integrator_properties(type, &p);
	fprintf(out, "| [`%s`](#%s) | %d | %d | %s | %s | %s | ", type->row.name, type->row.name, p.order, p.solves,
			p.a_stable ? "yes" : "no", p.l_stable ? "yes" : "no", p.stiffly_accurate ? "yes" : "no");
	print_number(out, p.r_infinity);
	fputs(" | ", out);
	print_number(out, p.stability_limit);
	fputs(" | ", out);
	print_count(out, p.dispersion_order);
	fputs(", ", out);
	print_number(out, p.dispersion);
	fputs(" | ", out);
	print_count(out, p.dissipation_order);
	fputs(", ", out);
	print_number(out, p.dissipation);
	fputs(" |\n", out);
}

static void print_tableau(FILE* out, const JnTableau* table) {
	fputs("\n```text\n", out);
	for (int i = 0; i < table->stages; ++i) {
		fprintf(out, "%12.8f |", table->c[i]);
		for (int j = 0; j <= i; ++j) fprintf(out, " %13.10f", table->a[i][j]);
		fputc('\n', out);
	}
	fprintf(out, "%12s |", "b");
	for (int j = 0; j < table->stages; ++j) fprintf(out, " %13.10f", table->b[j]);
	if (table->has_embedded) {
		fprintf(out, "\n%12s |", "b^");
		for (int j = 0; j < table->stages; ++j) fprintf(out, " %13.10f", table->b_embedded[j]);
	}
	fputs("\n```\n", out);
}

static void print_keys(FILE* out, const JnKey* keys) {
	for (; keys != NULL && keys->name != NULL; ++keys)
		fprintf(out, "- `integrator.%s` (default %g): %s.\n", keys->name, keys->value[0], keys->meaning);
}

static void section(FILE* out, const JnIntegratorType* type) {
	fprintf(out, "\n### %s\n\n%s.\n\n![Region of stability of %s](integrators/%s.png)\n\n", type->row.name,
			type->row.doc, type->row.name, type->row.name);
	print_keys(out, type->row.keys);
	const bool is_dirk = type->properties != NULL && type->table != NULL && (type->needs & JN_NEEDS_TANGENT) != 0;
	if (is_dirk) print_tableau(out, type->table);
}

static void write_page(FILE* out) {
	fputs("# Integrators\n\n"
		  "Written by `./dev docs` from the list of methods; do not edit. Properties follow from the coefficients, or "
		  "are "
		  "measured on\nan undamped oscillator with angular frequency ω and step h.\n\n"
		  "- **solves**: linear or nonlinear systems a step; **A**, **L**: A-stable, L-stable; **SA**: stiffly "
		  "accurate.\n"
		  "- **R(∞)**: amplification of infinitely fast oscillations. **limit**: largest stable ωh; – : none.\n"
		  "- **phase**: order q and constant of the phase error, constant · (ωh)^(q+1) a step; **loss**: the same for "
		  "the "
		  "amplitude.\n\n"
		  "The pictures show the z plane, z = hλ: green where a step does not grow, darker where it damps more. "
		  "Everything "
		  "left of the\nvertical axis should be green for stiff and damped motion.\n\n"
		  "| method | order | solves | A | L | SA | R(∞) | limit | phase | loss "
		  "|\n|---|---|---|---|---|---|---|---|---|---|\n",
		  out);
	for (int i = 0; i < jn_integrator_list.count; ++i)
		table_row(out, (const JnIntegratorType*)jn_integrator_list.rows[i]);
	for (int i = 0; i < jn_integrator_list.count; ++i)
		section(out, (const JnIntegratorType*)jn_integrator_list.rows[i]);
}

// A matrix of radii for gnuplot, from the top row down; only Im z >= 0, the rest mirrors it.
static void write_region(FILE* out, const JnIntegratorType* type) {
	for (int r = 0; r < ROWS; ++r) {
		const double im = top * (r + 0.5) / ROWS;
		for (int c = 0; c < COLUMNS; ++c) {
			const double re = left + (right - left) * (c + 0.5) / COLUMNS, nu = hypot(re, im);
			const double radius = jn_integrator_amplification(type, nu, -re / nu).radius;
			fprintf(out, "%.4g %.4g %.6g\n", re, im, isfinite(radius) ? fmin(radius, 1e6) : 1e6);
		}
		fputc('\n', out);
	}
}

static int draw(const char* folder, const JnIntegratorType* type) {
	FILE* plot = popen("gnuplot", "w");
	if (plot == NULL) return 1;
	fprintf(plot,
			"set terminal pngcairo size 480,330 font 'DejaVu Sans,9'\nset output '%s/integrators/%s.png'\n"
			"set title '%s' noenhanced\nset xlabel 'Re z'\nset ylabel 'Im z'\nset xrange [%g:%g]\nset yrange [0:%g]\n"
			"set cbrange [0:1.25]\nset cblabel 'growth a step'\n"
			"set palette defined (0 '#00441b', 0.5 '#41ab5d', 0.999 '#c7e9c0', 1.001 '#fff5eb', 1.25 '#d94801')\n"
			"set arrow from 0,0 to 0,%g nohead lc '#444444' front\nset tics out nomirror\n"
			"plot '-' using 1:2:($3 > 1.25 ? 1.25 : $3) with image notitle\n",
			folder, type->row.name, type->row.name, left, right, top, top);
	write_region(plot, type);
	fputs("e\n", plot);
	return pclose(plot);
}

int main(int count, char** arguments) {
	char path[1024];
	if (count != 2) return fputs("usage: integrator_pages FOLDER\n", stderr), 2;
	snprintf(path, sizeof path, "%s/integrators", arguments[1]);
	mkdir(path, 0777);
	snprintf(path, sizeof path, "%s/integrators.md", arguments[1]);
	FILE* page = fopen(path, "w");
	if (page == NULL) return perror(path), 3;
	write_page(page);
	int status = fclose(page) != 0;
	for (int i = 0; i < jn_integrator_list.count && status == 0; ++i)
		status = draw(arguments[1], (const JnIntegratorType*)jn_integrator_list.rows[i]);
	return status;
}
