/// @file key.h
/// Key tables at work: fill structs from a document, check, describe.
#ifndef JN_BASE_KEY_H
#define JN_BASE_KEY_H

#include <stdio.h>

#include "base/document.h"
#include "jounce/extend.h"

/// Fill `out` (a struct described by `keys`) from `mapping`, which may be NULL for defaults only. `path` is the dotted
/// path of the mapping for messages ("" at the root). Unknown keys, wrong kinds, units and bounds end with JN_BAD_INPUT
/// and a message `file:line:column: path: value is ...; remedy`.
JnStatus jn_keys_read(const JnKey* keys, const JnNode* mapping, const char* path, JnArena* arena, void* out);

/// Find the row of a catalogue; NULL when there is none.
const JnRow* jn_row_find(const JnRowList* list, const char* name);

/// The candidate nearest to `word` by edit distance, or NULL when none is near; `next` yields candidates until NULL.
const char* jn_suggest(const char* word, const char* (*next)(void* context, int index), void* context);

/// Convert "33 ms", "1e5 Pa", "-9.81 m/s^2", "1/96 m" or a bare number to SI. `unit` is the wanted SI unit. Returns
/// NULL, or a static sentence fragment that says what is wrong ("is no number", "has the unit kg, expected a time [s]").
const char* jn_quantity_parse(const char* text, const char* unit, double* value);

/// Print the keys below `path` ("" for all; "bodies.material.poisson"; list indices may be left out): as aligned text,
/// or as Markdown tables. Returns JN_BAD_INPUT, with a suggestion, when there is no such key.
JnStatus jn_keys_describe(const JnKey* keys, const char* path, bool markdown, FILE* out);

#endif
