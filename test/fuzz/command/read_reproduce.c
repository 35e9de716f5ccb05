// The option reader of jounce reproduce, which no other file sees.
#include "command.h"
#include "reproduce.c"

int fuzz_read_reproduce(int count, char** arguments) {
	ReproduceOptions options;
	return read_options(count, arguments, &options);
}
