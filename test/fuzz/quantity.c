// Numbers with units: the first byte chooses the unit that is wanted, the rest is the text.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/key.h"
#include "base/quantity.h"
#include "support/fuzz.h"

static const char* const units[] = {NULL,  "",    "s",    "m",      "kg",     "N",     "Pa",    "J",   "m/s", "m/s^2",
									"1/s", "N/m", "Pa s", "kg/m^3", "kg/m^2", "N s/m", "N/m^2", "rad", "1/m", "m^2"};

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
	if (size == 0) return 0;
	const char* unit = units[data[0] % (sizeof units / sizeof units[0])];
	char* text = fuzz_text(data + 1, size - 1);
	char sentence[120];
	double value = 0;
	const char* rest = NULL;
	const JnQuantityFault fault = jn_quantity_read(text, unit, &value, &rest);
	if (fault == JN_QUANTITY_FINE && !isfinite(value)) abort();
	if (fault == JN_QUANTITY_UNKNOWN_UNIT && (rest < text || rest > text + strlen(text))) abort();
	if ((jn_quantity_parse(text, unit, &value) == NULL) != (fault == JN_QUANTITY_FINE)) abort();
	if (fault != JN_QUANTITY_FINE) {
		jn_quantity_explain(text, unit, sizeof sentence, sentence);
		if (strlen(sentence) == 0) abort();
		jn_quantity_expect(unit, 20, sentence);
	}
	free(text);
	return 0;
}
