/// @file json.h
/// Writing JSON: words are escaped, bytes that are no UTF-8 become U+FFFD, numbers that are none become null.
#ifndef JN_APP_JSON_H
#define JN_APP_JSON_H

#include <stdio.h>

/// A string in quotes; NULL: null.
void json_print_text(FILE* out, const char* text);

/// A number that reads back to the same double; null when it is not finite.
void json_print_real(FILE* out, double value);

/// `"name": value,` and a new line.
void json_print_text_entry(FILE* out, const char* name, const char* text);
void json_print_real_entry(FILE* out, const char* name, double value);
void json_print_integer_entry(FILE* out, const char* name, long value);

#endif
