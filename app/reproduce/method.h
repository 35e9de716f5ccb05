/// @file method.h
/// The integration methods of the papers, by their names there, and how their curves look.
#ifndef JN_APP_REPRODUCE_METHOD_H
#define JN_APP_REPRODUCE_METHOD_H

#include "record/text_file.h"

typedef struct Method {
	const char* name;  ///< integrator.method
	const char* title; ///< in the papers
	const char* colour;
} Method;

enum { PAPER_METHODS = 9, METHODS = 14 };

/// Those of the paper HO first.
extern const Method method_list[METHODS];

/// What a curve of a method looks like: "lw 1.8 lc rgb '#...'".
void method_print_pen(JnTextFile* file, int method);

/// The beginning of a script that plots CSV files on a logarithmic axis into `name`.png of that size.
void method_print_head(JnTextFile* file, const char* name, int width, int height);

#endif
