/// @file quantity.h
/// Numbers with units, and sentences about what is wrong with them. The short form is jn_quantity_parse in key.h.
#ifndef JN_BASE_QUANTITY_H
#define JN_BASE_QUANTITY_H

#include <stddef.h>

typedef enum JnQuantityFault {
	JN_QUANTITY_FINE,
	JN_QUANTITY_NO_NUMBER,
	JN_QUANTITY_NOT_FINITE,
	JN_QUANTITY_UNKNOWN_UNIT,
	JN_QUANTITY_WRONG_UNIT,
} JnQuantityFault;

/// Convert `text` to `unit`; NULL or "" wants a pure number. `*unit_text` is where the unit begins in `text`.
JnQuantityFault jn_quantity_read(const char* text, const char* unit, double* value, const char** unit_text);

/// Write what a unit measures, with an example: "a time is expected, such as 33 ms". Cut to `size`.
void jn_quantity_expect(const char* unit, size_t size, char* sentence);

/// Write what is wrong with `text`: "'33 kg' has the unit kg, but a time is expected, such as 33 ms". Cut to `size`.
void jn_quantity_explain(const char* text, const char* unit, size_t size, char* sentence);

#endif
