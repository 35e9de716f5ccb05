/// @file draw.h
/// Where random numbers and words for a key come from: its own bounds, or narrower hints by the path at which it stands.
#ifndef JN_TEST_RANDOM_DRAW_H
#define JN_TEST_RANDOM_DRAW_H

#include <stdbool.h>

#include "base/random.h"
#include "jounce/extend.h"

/// What is reasonable at the places that `path` matches (fnmatch; names of rows are parts of paths, indices are not).
typedef struct Hint {
	const char* path;
	double chance;     ///< that an optional key is given; 0: the usual one
	double low, high;  ///< numbers, and counts of lists; both 0: as the key says
	const char* words; ///< texts to choose from, divided by '|'; they stand for values of any kind
	bool is_hard;      ///< holds in wild scenes too: sizes of meshes and lists
} Hint;

extern const Hint hints[]; ///< `path` NULL at the end

/// Exactly one of these keys of the table at `path` is given.
typedef struct Choice {
	const char* path;
	const char* names; ///< divided by '|'; a name that stands there twice is twice as likely
} Choice;

extern const Choice choices[]; ///< `path` NULL at the end

/// The first hint for a path; never NULL.
const Hint* hint_for(const char* path);

/// Word `index` of "a|b|c", in static storage until the next call; NULL behind the last one.
const char* word_at(const char* words, int index);
const char* draw_word(JnRandom* random, const char* words);

bool draw_chance(JnRandom* random, double probability);
int draw_integer(JnRandom* random, int low, int high); ///< both included

/// A number for a key: within the hint, or, when `is_wild`, anywhere within the key's bounds and often on them.
double draw_number(JnRandom* random, const JnKey* key, const Hint* hint, bool is_wild);

#endif
