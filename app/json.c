#include "json.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

// Bytes of the UTF-8 character at `text`, or 0 when there is none.
static int measure_character(const unsigned char* text) {
	const unsigned char lead = text[0];
	if (lead < 0x80) return 1;
	const int length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
	if (lead < 0xC2 || lead > 0xF4) return 0;
	for (int i = 1; i < length; ++i)
		if ((text[i] & 0xC0) != 0x80) return 0;
	const bool is_overlong = (lead == 0xE0 && text[1] < 0xA0) || (lead == 0xF0 && text[1] < 0x90);
	const bool is_outside = (lead == 0xED && text[1] > 0x9F) || (lead == 0xF4 && text[1] > 0x8F);
	return is_overlong || is_outside ? 0 : length;
}

void json_print_text(FILE* out, const char* text) {
	if (text == NULL) {
		fputs("null", out);
		return;
	}
	fputc('"', out);
	while (*text != '\0') {
		const int length = measure_character((const unsigned char*)text);
		if (length == 0)
			fputs("\\ufffd", out);
		else if (*text == '"' || *text == '\\')
			fprintf(out, "\\%c", *text);
		else if ((unsigned char)*text < 0x20 || *text == '<') // no "</script>" ends a page that holds it
			fprintf(out, "\\u%04x", *text);
		else
			fwrite(text, 1, (size_t)length, out);
		text += length > 0 ? length : 1;
	}
	fputc('"', out);
}

void json_print_real(FILE* out, double value) {
	char digits[32];
	snprintf(digits, sizeof digits, "%.15g", value);
	if (strtod(digits, NULL) != value) snprintf(digits, sizeof digits, "%.17g", value);
	fputs(isfinite(value) ? digits : "null", out);
}

void json_print_text_entry(FILE* out, const char* name, const char* text) {
	json_print_text(out, name);
	fputs(": ", out);
	json_print_text(out, text);
	fputs(",\n", out);
}

void json_print_real_entry(FILE* out, const char* name, double value) {
	json_print_text(out, name);
	fputs(": ", out);
	json_print_real(out, value);
	fputs(",\n", out);
}

void json_print_integer_entry(FILE* out, const char* name, long value) {
	json_print_text(out, name);
	fprintf(out, ": %ld,\n", value);
}
