// "Did you mean": the nearest word by the edit distance that counts an insertion, a deletion, a replacement and a swap
// of neighbours as one each (optimal string alignment, the restricted Damerau-Levenshtein distance). Case is free.
#include <ctype.h>
#include <string.h>

#include "base/key.h"

enum { LONGEST = 63 };

static int smaller(int a, int b) {
	return a < b ? a : b;
}

static bool same(char a, char b) {
	return tolower((unsigned char)a) == tolower((unsigned char)b);
}

static int edit_distance(const char* a, const char* b) {
	const int rows = (int)strlen(a), columns = (int)strlen(b);
	int d[LONGEST + 1][LONGEST + 1];
	for (int i = 0; i <= rows; i++) d[i][0] = i;
	for (int j = 0; j <= columns; j++) d[0][j] = j;
	for (int i = 1; i <= rows; i++) {
		for (int j = 1; j <= columns; j++) {
			const int replaced = d[i - 1][j - 1] + !same(a[i - 1], b[j - 1]);
			d[i][j] = smaller(replaced, smaller(d[i - 1][j], d[i][j - 1]) + 1);
			const bool swaps = i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]);
			if (swaps) d[i][j] = smaller(d[i][j], d[i - 2][j - 2] + 1);
		}
	}
	return d[rows][columns];
}

const char* jn_suggest(const char* word, const char* (*next)(void* context, int index), void* context) {
	const int length = (int)strlen(word);
	if (length > LONGEST) return NULL;
	int limit = length / 3 > 1 ? length / 3 : 1;
	const char* nearest = NULL;
	const char* candidate;
	for (int i = 0; (candidate = next(context, i)) != NULL; i++) {
		const int other = (int)strlen(candidate);
		if (other > LONGEST) continue;
		const int distance = edit_distance(word, candidate);
		const bool shares_nothing = distance >= (length > other ? length : other);
		if (distance > limit || shares_nothing) continue;
		nearest = candidate;
		limit = distance - 1; // the first of equals wins
	}
	return nearest;
}
