// Reference, limits and costs in their order, and what is told meanwhile.
#include <math.h>
#include <stdarg.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/log.h"
#include "base/timer.h"
#include "score.h"

bool score_is_stopped(const Score* score) {
	return score->stop != NULL && *score->stop != 0;
}

static void tell_limit(Score* score, const ScoreMethod* method, double seconds) {
	if (isnan(method->limit)) return;
	if (method->limit == 0)
		score_tell(score, "%s: no stable step (%d runs, %.1f s)%s%s", method->type->row.name, method->runs, seconds,
				   method->failure[0] != '\0' ? ": " : "", method->failure);
	else
		score_tell(score, "%s: largest stable step %s%.4g s (%d runs, %.1f s)", method->type->row.name,
				   method->is_capped ? ">= " : "", method->limit, method->runs, seconds);
}

JnStatus score_measure(Score* score) {
	JN_TRY(score_find_reference(score));
	if (!score_is_stopped(score))
		score_tell(score, "reference: %s with %.3g s; %.4g J in motion", score->reference->row.name,
				   score->reference_dt, score->scale);
	for (int i = 0; i < score->count && !score_is_stopped(score); ++i) {
		const double began = jn_seconds();
		JN_TRY(score_find_limit(score, &score->list[i]));
		tell_limit(score, &score->list[i], jn_seconds() - began);
	}
	if (!score_is_stopped(score)) JN_TRY(score_find_costs(score));
	score->was_stopped = score_is_stopped(score);
	score_show(score, "%s", "");
	return JN_OK;
}

static int terminal_width(void) {
	struct winsize size;
	return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void score_show(Score* score, const char* format, ...) {
	char line[512];
	va_list values;
	const double now = jn_seconds();
	if (score->options->is_quiet || !score->is_terminal || (*format != '\0' && now - score->told < 0.1)) return;
	va_start(values, format);
	vsnprintf(line, sizeof line, format, values);
	va_end(values);
	printf("\r%.*s\033[K", terminal_width() - 1, line);
	fflush(stdout);
	score->told = now;
}

void score_tell(Score* score, const char* format, ...) {
	va_list values;
	if (score->options->is_quiet) return;
	if (score->is_terminal) fputs("\r\033[K", stdout);
	va_start(values, format);
	vprintf(format, values);
	va_end(values);
	putchar('\n');
	fflush(stdout);
}
