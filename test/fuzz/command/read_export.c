// The option reader of jounce export, which no other file sees.
#include "command.h"
#include "export.c"

int fuzz_read_export(int count, char** arguments) {
	Options options = {0};
	Export export = {0};
	FrameRange range;
	int status = read_options(count, arguments, &options, &export);
	if (status == EXIT_DONE) status = app_read_frames("export", options.frames, 10, &range);
	return status;
}
