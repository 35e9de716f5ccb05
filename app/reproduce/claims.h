/// @file claims.h
/// What a paper says, beside the numbers that confirm or refute it.
#ifndef JN_APP_REPRODUCE_CLAIMS_H
#define JN_APP_REPRODUCE_CLAIMS_H

#include "reproduce/table.h"

typedef enum ClaimVerdict { CLAIM_UNKNOWN, CLAIM_CONFIRMED, CLAIM_REFUTED } ClaimVerdict;

/// CLAIM_UNKNOWN when a number that `holds` comes from is NAN.
ClaimVerdict claim_judge(bool holds, int count, const double* numbers);

/// A table of claims.
Table claims_begin(JnArena* arena);
/// Add one: the paper's words, the numbers, and what follows from them.
void claims_add(Table* table, const char* words, ClaimVerdict verdict, const char* format, ...)
	__attribute__((format(printf, 4, 5)));

#endif
