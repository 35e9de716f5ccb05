// Reads behind the end of a block: the address sanitizer must say so.
#include <stdio.h>
#include <stdlib.h>

int main(int count, char** arguments) {
	(void)arguments;
	int* block = calloc((size_t)count, sizeof *block);
	if (block == NULL) return 1;
	printf("%d\n", block[count]);
	free(block);
	return 0;
}
