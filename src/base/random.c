#include "base/random.h"

uint64_t jn_random_bits(JnRandom* random) {
	uint64_t z = random->state += 0x9e3779b97f4a7c15u; // 2^64 / golden ratio, made odd
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	return z ^ (z >> 31);
}

double jn_random_uniform(JnRandom* random) {
	return (double)(jn_random_bits(random) >> 11) * 0x1p-53;
}

void jn_random_in_ball(JnRandom* random, double point[3]) {
	double square = 2;
	while (square > 1) {
		for (int axis = 0; axis < 3; ++axis) point[axis] = 2 * jn_random_uniform(random) - 1;
		square = point[0] * point[0] + point[1] * point[1] + point[2] * point[2];
	}
}
