// The option reader of jounce report, which no other file sees.
#include "command.h"
#include "report.c"

int fuzz_read_report(int count, char** arguments) {
	Command command;
	return read_options(count, arguments, &command);
}
