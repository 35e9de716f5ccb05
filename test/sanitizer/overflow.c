// Adds to the largest integer: the undefined-behaviour sanitizer must say so.
#include <limits.h>
#include <stdio.h>

int main(int count, char** arguments) {
	(void)arguments;
	printf("%d\n", INT_MAX - 1 + count + count);
	return 0;
}
