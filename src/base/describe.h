/// @file describe.h
/// The two forms in which key tables are printed; jn_keys_describe in key.h chooses what is printed.
#ifndef JN_BASE_DESCRIBE_H
#define JN_BASE_DESCRIBE_H

#include <stdio.h>

#include "base/key.h"

/// A part of a key table, and where it stands.
typedef struct JnKeyPart {
	const JnKey* keys; ///< NULL: none
	int count;         ///< keys of it that are meant
	const JnRow* row;  ///< the row that owns the keys, to be named above them; NULL: none
	const char* tag;   ///< the entry that names that row
	const char* path;  ///< dotted path of the mapping that holds the keys; "" at the root
} JnKeyPart;

/// What describes one key, apart from its name and meaning.
typedef struct JnKeyCells {
	char kind[48];   ///< "number", "list of mappings", or the noun of a catalogue
	char value[64];  ///< the default, "required", or ""
	char bounds[64]; ///< an interval, or ""
	char words[600]; ///< the words of a choice, or ""
} JnKeyCells;

enum { JN_DESCRIBE_DEPTH = 24 }; ///< tables that can stand inside each other

/// Tables and catalogues that are being printed, so that one that holds itself ends.
typedef struct JnOpenTables {
	const void* tables[JN_DESCRIBE_DEPTH];
	int count;
} JnOpenTables;

void jn_key_cells(const JnKey* key, JnKeyCells* cells);

/// Number of keys in a table; 0 for NULL.
int jn_keys_count(const JnKey* keys);

/// The earlier row of the list that has the same keys as row `index`, or NULL.
const JnRow* jn_row_with_same_keys(const JnRowList* list, int index);

/// Note that `table` is being printed; false when it is already, or when the depth is used up.
bool jn_open_tables_push(JnOpenTables* open, const void* table);

/// Aligned text; nested tables are indented.
void jn_describe_text(const JnKeyPart* part, FILE* out);

/// Markdown: a heading and a table for each mapping and for each row that has keys.
void jn_describe_markdown(const JnKeyPart* part, FILE* out);

#endif
