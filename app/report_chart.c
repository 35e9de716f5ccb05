// Axes with round numbers, and each curve thinned to the lowest and the highest value over every pixel of its width.
#include "report_chart.h"

#include <math.h>
#include <string.h>

enum {
	WIDTH = 560,
	HEIGHT = 250,
	LEFT = 66,
	RIGHT = 12,
	TOP = 10,
	BOTTOM = 34,
	MOST_TICKS = 40,
	MOST_DECADES = 12,
	COLOURS = 8
};

static const char* const colours[COLOURS] = {"#3b82d6", "#e07b39", "#2f9e6e", "#b65fb0",
											 "#c9a21f", "#6d68cf", "#2aa3b3", "#d2574d"};
static const char* const dashes[] = {"none", "6 4", "2 3"};

typedef struct Axis {
	double low, high;
	bool is_log; // low and high are then logarithms
	double step;
} Axis;

static double place_of(const Axis* axis, double value) {
	const double at = axis->is_log ? (value > 0 ? log10(value) : NAN) : value;
	return (at - axis->low) / (axis->high - axis->low);
}

static void widen(Axis* axis, long count, const double* values) {
	for (long i = 0; i < count; ++i) {
		const double at = axis->is_log ? (values[i] > 0 ? log10(values[i]) : NAN) : values[i];
		if (!isfinite(at)) continue;
		axis->low = fmin(axis->low, at);
		axis->high = fmax(axis->high, at);
	}
}

// The distance of 1, 2 or 5 times a power of ten that gives about `wanted` parts.
static double round_step(double span, int wanted) {
	static const double digits[] = {1, 2, 5, 10};
	const double power = pow(10, floor(log10(span / wanted)));
	for (int i = 0; i < 4; ++i)
		if (span / (digits[i] * power) <= wanted) return digits[i] * power;
	return 10 * power;
}

static void finish_axis(Axis* axis, int wanted, bool is_exact) {
	if (!(axis->high > axis->low)) {
		const double half = axis->is_log ? 1 : fmax(fabs(axis->low), 1e-12) / 2;
		axis->low -= half;
		axis->high += half;
	}
	axis->step = round_step(axis->high - axis->low, wanted);
	if (axis->is_log) axis->step = fmax(1, ceil(axis->step));
	if (is_exact) return;
	axis->low = axis->step * floor(axis->low / axis->step + 1e-9);
	axis->high = axis->step * ceil(axis->high / axis->step - 1e-9);
}

static void print_tick(JnTextFile* file, const Axis* axis, double at) {
	const double value = fabs(at) < 1e-9 * axis->step ? 0 : at;
	if (axis->is_log)
		jn_text_print(file, "10<tspan dy=\"-5\" font-size=\"9\">%.0f</tspan>", value);
	else
		jn_text_print(file, "%.6g", value);
}

static void print_axes(JnTextFile* file, const Axis* x, const Axis* y) {
	const double width = WIDTH - LEFT - RIGHT, height = HEIGHT - TOP - BOTTOM;
	for (int i = 0; i < MOST_TICKS; ++i) {
		const double at = x->step * (ceil(x->low / x->step - 1e-9) + i),
					 left = LEFT + width * (at - x->low) / (x->high - x->low);
		if (at > x->high + 1e-9 * x->step) break;
		jn_text_print(file,
					  "<path class=\"grid\" d=\"M%.1f %d V%d\"/><text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">",
					  left, TOP, HEIGHT - BOTTOM, left, HEIGHT - BOTTOM + 15);
		print_tick(file, x, at);
		jn_text_print(file, "</text>");
	}
	for (int i = 0; i < MOST_TICKS; ++i) {
		const double at = y->step * (ceil(y->low / y->step - 1e-9) + i),
					 top = TOP + height * (1 - (at - y->low) / (y->high - y->low));
		if (at > y->high + 1e-9 * y->step) break;
		jn_text_print(file, "<path class=\"grid\" d=\"M%d %.1f H%d\"/><text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">",
					  LEFT, top, WIDTH - RIGHT, LEFT - 7, top + 4);
		print_tick(file, y, at);
		jn_text_print(file, "</text>");
	}
	jn_text_print(file, "<text x=\"%d\" y=\"%d\" text-anchor=\"end\">t [s]</text>", WIDTH - RIGHT, HEIGHT - 4);
}

typedef struct Pen {
	JnTextFile* file;
	const Axis *x, *y;
	bool is_down;
} Pen;

static void draw_to(Pen* pen, double t, double y) {
	const double across = place_of(pen->x, t), up = place_of(pen->y, y);
	if (!isfinite(across) || !isfinite(up) || up < -1e-9) {
		pen->is_down = false;
		return;
	}
	jn_text_print(pen->file, "%s%.1f %.1f", pen->is_down ? " " : "M", LEFT + (WIDTH - LEFT - RIGHT) * across,
				  TOP + (HEIGHT - TOP - BOTTOM) * (1 - up));
	pen->is_down = true;
}

// Lowest and highest of the values from first to last, in the order in which they come.
static void draw_extremes(Pen* pen, const ReportCurve* curve, long first, long last) {
	long low = first, high = first;
	for (long i = first; i < last; ++i) {
		if (curve->y[i] < curve->y[low] || !isfinite(curve->y[low])) low = i;
		if (curve->y[i] > curve->y[high] || !isfinite(curve->y[high])) high = i;
	}
	const long sooner = low < high ? low : high, later = low < high ? high : low;
	draw_to(pen, curve->t[sooner], curve->y[sooner]);
	if (later != sooner) draw_to(pen, curve->t[later], curve->y[later]);
}

static void print_curve(JnTextFile* file, const ReportCurve* curve, int number, const Axis* x, const Axis* y) {
	Pen pen = {.file = file, .x = x, .y = y};
	const long columns = WIDTH - LEFT - RIGHT, bin = 1 + curve->count / columns;
	jn_text_print(file, "<path class=\"curve\" stroke=\"%s\" stroke-dasharray=\"%s\" d=\"", colours[number % COLOURS],
				  dashes[number / COLOURS % 3]);
	if (curve->count > 0) draw_to(&pen, curve->t[0], curve->y[0]);
	for (long i = 1; i + 1 < curve->count; i += bin)
		draw_extremes(&pen, curve, i, i + bin < curve->count - 1 ? i + bin : curve->count - 1);
	if (curve->count > 1) draw_to(&pen, curve->t[curve->count - 1], curve->y[curve->count - 1]);
	jn_text_print(file, "\"/>\n");
}

static void print_escaped(JnTextFile* file, const char* text) {
	for (; *text != '\0'; ++text)
		if (strchr("&<>\"", *text) != NULL)
			jn_text_print(file, "&#%d;", *text);
		else
			jn_text_write(file, text, 1);
}

static void print_caption(JnTextFile* file, const ReportChart* chart) {
	jn_text_print(file, "<figure><figcaption><b>");
	print_escaped(file, chart->title);
	if (*chart->unit != '\0') jn_text_print(file, " [%s]", chart->unit);
	jn_text_print(file, "</b>");
	for (int i = 0; i < chart->count && chart->count > 1; ++i) {
		jn_text_print(file,
					  " <span class=\"key\"><svg width=\"22\" height=\"8\" aria-hidden=\"true\"><path d=\"M0 4H22\" "
					  "class=\"curve\" "
					  "stroke=\"%s\" stroke-dasharray=\"%s\"/></svg> ",
					  colours[i % COLOURS], dashes[i / COLOURS % 3]);
		print_escaped(file, chart->curves[i].name);
		jn_text_print(file, "</span>");
	}
	jn_text_print(file, "</figcaption>\n<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"", WIDTH, HEIGHT);
	print_escaped(file, chart->title);
	jn_text_print(file, " over time\">\n");
}

void report_chart_print(JnTextFile* file, const ReportChart* chart) {
	Axis x = {.low = INFINITY, .high = -INFINITY}, y = {.low = INFINITY, .high = -INFINITY, .is_log = chart->is_log};
	for (int i = 0; i < chart->count; ++i) {
		widen(&x, chart->curves[i].count, chart->curves[i].t);
		widen(&y, chart->curves[i].count, chart->curves[i].y);
	}
	if (!isfinite(x.low) || !isfinite(y.low) || (!y.is_log && y.low == 0 && y.high == 0)) return;
	if (y.is_log) y.low = fmax(y.low, y.high - MOST_DECADES); // what is far below the largest is rounding
	finish_axis(&x, 8, true);
	finish_axis(&y, 6, false);
	print_caption(file, chart);
	print_axes(file, &x, &y);
	for (int i = 0; i < chart->count; ++i) print_curve(file, &chart->curves[i], i, &x, &y);
	jn_text_print(file, "</svg></figure>\n");
}
