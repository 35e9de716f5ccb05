// Two threads of a team write to the same number: the thread sanitizer must say so.
#include <stdio.h>

int main(void) {
	int sum = 0;
#pragma omp parallel for schedule(static) num_threads(2)
	for (int i = 0; i < 1000; ++i) sum += i;
	printf("%d\n", sum);
	return 0;
}
