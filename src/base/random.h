/// @file random.h
/// Random numbers that are the same on every machine: SplitMix64 (Steele, Lea, Flood 2014), integer arithmetic alone.
#ifndef JN_BASE_RANDOM_H
#define JN_BASE_RANDOM_H

#include <stdint.h>

/// A stream of random numbers. `{seed}` starts one; any seed is good, 0 as well.
typedef struct JnRandom {
	uint64_t state;
} JnRandom;

/// The next 64 random bits. The stream repeats after 2^64 numbers.
uint64_t jn_random_bits(JnRandom* random);

/// Uniform in [0, 1): a multiple of 2^-53.
double jn_random_uniform(JnRandom* random);

/// Uniform in the ball of radius 1 about 0. Takes three numbers of the stream at a time until they lie in the ball (1.9
/// times on average), so that nothing is rounded differently elsewhere.
void jn_random_in_ball(JnRandom* random, double point[3]);

#endif
