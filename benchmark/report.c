// Rows of results: which are wanted, their rates, and how they are written, to the terminal and as CSV.
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "bench.h"

const char* const reference_names[REFERENCES] = {"fma_peak", "l2_read", "l3_read", "triad"};

bool bench_wants(const Bench* bench, const char* group, const char* name, const char* size) {
	char full[160];
	snprintf(full, sizeof full, "%s.%s.%s", group, name, size);
	for (int i = 0; i < bench->word_count; ++i)
		if (strstr(full, bench->words[i]) != NULL) return true;
	return bench->word_count == 0;
}

Timing timing_in(Timing seconds, double unit, double count) {
	const double scale = 1 / (unit * count);
	return (Timing){seconds.median * scale, seconds.min * scale, seconds.max * scale};
}

void row_set_flops(const Bench* bench, Row* row, double seconds, double work) {
	row->rate = 1e-9 * work / seconds;
	row->rate_unit = "Gflop/s";
	row->fraction_of = reference_names[FMA_PEAK];
	row->fraction = work / seconds / bench->reference[FMA_PEAK][row->threads > 1];
}

void row_set_bytes(const Bench* bench, Row* row, double seconds, double bytes, double resident) {
	const long l2 = sysconf(_SC_LEVEL2_CACHE_SIZE), l3 = sysconf(_SC_LEVEL3_CACHE_SIZE);
	const Reference reference = resident < (double)l2 ? L2_READ : resident < (double)l3 ? L3_READ : TRIAD;
	row->rate = 1e-9 * bytes / seconds;
	row->rate_unit = "GB/s";
	row->fraction_of = reference_names[reference];
	row->fraction = bytes / seconds / bench->reference[reference][row->threads > 1];
}

static void write_number(FILE* out, double number, const char* format) {
	if (number != 0 && isfinite(number)) fprintf(out, format, number);
}

static const char* text_of(const char* text) {
	return text != NULL ? text : "";
}

static void write_csv(FILE* csv, const Row* row) {
	fprintf(csv, "%s,%s,%s,%d,", row->group, row->name, row->size, row->threads);
	if (row->width > 0) fprintf(csv, "%d", row->width);
	fprintf(csv, ",%.5g,%.5g,%.5g,%s,", row->value.median, row->value.min, row->value.max, row->unit);
	write_number(csv, row->rate, "%.4g");
	fprintf(csv, ",%s,%s,", text_of(row->rate_unit), text_of(row->fraction_of));
	write_number(csv, row->fraction, "%.3f");
	fputc('\n', csv);
	fflush(csv);
}

void bench_report(const Bench* bench, const Row* row) {
	if (bench->csv != NULL) write_csv(bench->csv, row);
	char width[16] = "", rate[40] = "", fraction[48] = "";
	if (row->width > 0) snprintf(width, sizeof width, "w%d", row->width);
	if (row->rate != 0) snprintf(rate, sizeof rate, "%9.4g %s", row->rate, text_of(row->rate_unit));
	if (row->fraction_of != NULL && row->fraction != 0)
		snprintf(fraction, sizeof fraction, "%5.1f %% of %s", 100 * row->fraction, row->fraction_of);
	printf("%-8s %-34s %-10s %dt %-3s %10.4g %-10s [%.4g, %.4g]  %s  %s\n", row->group, row->name, row->size,
		   row->threads, width, row->value.median, row->unit, row->value.min, row->value.max, rate, fraction);
	fflush(stdout);
}
