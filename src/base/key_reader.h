/// @file key_reader.h
/// What the parts of the key reader share: where it stands, its messages, lists of names, and the readers of values.
#ifndef JN_BASE_KEY_READER_H
#define JN_BASE_KEY_READER_H

#include "base/key.h"

/// Where reading stands.
typedef struct JnKeyReader {
	JnArena* arena;      ///< receives texts, lists and options
	const JnNode* where; ///< nearest mapping that exists, the place of messages about absent keys; NULL: none
	bool requires;       ///< required keys must be given; false when only defaults are wanted
	char path[512];      ///< dotted path of what is being read
} JnKeyReader;

/// Go into an entry or, with name NULL, into list entry `index`. Returns the mark that jn_key_leave takes.
size_t jn_key_enter(JnKeyReader* reader, const char* name, int index);
void jn_key_leave(JnKeyReader* reader, size_t mark);

/// Log "place: path: message" and return JN_BAD_INPUT. `node` may be NULL: then there is no place.
JnStatus jn_key_error(const JnKeyReader* reader, const JnNode* node, const char* format, ...)
	__attribute__((format(printf, 3, 4)));

/// Log that a node has the wrong kind: "is a list, but a number is expected".
JnStatus jn_key_kind_error(const JnKeyReader* reader, const JnNode* node, const char* expected);

/// Names that may stand in one place: a tag, then keys, then rows. Each may be NULL.
typedef struct JnNames {
	const char* tag;
	const JnKey* keys;
	const JnRowList* rows;
	const char* const* words; ///< NULL at the end
} JnNames;

/// The name of that index in a JnNames, or NULL behind the last: a candidate list for jn_suggest.
const char* jn_names_next(void* names, int index);

/// Write "; did you mean 'x'?" if a name is near, else "". Cut to `size`.
void jn_names_suggest(JnNames names, const char* word, size_t size, char* sentence);

/// Write the names with commas; "..." where they do not fit.
void jn_names_list(JnNames names, size_t size, char* text);

/// How each kind that holds no table is read from a node; `field` has the kind's type.
JnStatus jn_read_real(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);
JnStatus jn_read_integer(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);
JnStatus jn_read_switch(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);
JnStatus jn_read_text(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);
JnStatus jn_read_path(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);
JnStatus jn_read_real2(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);
JnStatus jn_read_integer2(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);
JnStatus jn_read_real3(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);
JnStatus jn_read_integer3(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);
JnStatus jn_read_points(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);
JnStatus jn_read_choice(JnKeyReader* reader, const JnKey* key, const JnNode* node, void* field);

/// Fill a field of such a kind with its default.
JnStatus jn_default_value(JnKeyReader* reader, const JnKey* key, void* field);

/// Write bounds as an interval such as "[0, 0.5)", with "infinity" where there is none; "" when unbounded.
void jn_bounds_text(const JnKey* key, size_t size, char* text);

#endif
