/// @file ex_claims.h
/// What EX says about its score sheet, beside the numbers (study ex-table).
#ifndef JN_APP_REPRODUCE_EX_CLAIMS_H
#define JN_APP_REPRODUCE_EX_CLAIMS_H

#include "reproduce/claims.h"
#include "reproduce/ex_accuracy.h"

static const double EX_TIE = 0.03; // scores nearer than that change places from run to run

/// Places, limits and costs on a scoreboard.
void ex_claims_add(const Score* score, Table* table);
/// Accuracy and energy on a scoreboard without damping.
void ex_claims_add_accuracy(const Score* undamped, const ExAccuracy* accuracy, Table* table);

/// The method of that name; one whose numbers are NAN where it is not among those of the score.
const ScoreMethod* ex_method(const Score* score, const char* name);

#endif
