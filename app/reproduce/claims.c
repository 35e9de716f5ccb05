#include "reproduce/claims.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

ClaimVerdict claim_judge(bool holds, int count, const double* numbers) {
	for (int i = 0; i < count; ++i)
		if (isnan(numbers[i])) return CLAIM_UNKNOWN;
	return holds ? CLAIM_CONFIRMED : CLAIM_REFUTED;
}

Table claims_begin(JnArena* arena) {
	return table_begin(arena, "the paper|the numbers|verdict");
}

void claims_add(Table* table, const char* words, ClaimVerdict verdict, const char* format, ...) {
	static const char* const verdicts[] = {"not known", "confirmed", "refuted"};
	char text[512];
	va_list values;
	va_start(values, format);
	vsnprintf(text, sizeof text, format, values);
	va_end(values);
	table_row(table, "%s|%s|%s", words, text, verdicts[verdict]);
}
