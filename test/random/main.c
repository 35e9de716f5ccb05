// Prints a scene drawn at random, or runs many: what test/random/run_random_scenes judges.
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>

#include "random_scene.h"
#include "run.h"

static const char usage[] =
	"usage: random_scene --seed S --index I [--attempt A]\n"
	"       random_scene --seed S --first I --count N --run FOLDER [--steps N] [--attempts N] [--cpu SECONDS]\n"
	"                    [--memory MIB] [--files MIB]\n";

enum { SEED, INDEX, ATTEMPT, FIRST, COUNT, STEPS, ATTEMPTS, CPU, MEMORY, FILES, NUMBERS, RUN };

static const struct option known[] = {
	{"seed", 1, NULL, SEED},     {"index", 1, NULL, INDEX}, {"attempt", 1, NULL, ATTEMPT},   {"first", 1, NULL, FIRST},
	{"count", 1, NULL, COUNT},   {"steps", 1, NULL, STEPS}, {"attempts", 1, NULL, ATTEMPTS}, {"cpu", 1, NULL, CPU},
	{"memory", 1, NULL, MEMORY}, {"files", 1, NULL, FILES}, {"run", 1, NULL, RUN},           {0},
};

int main(int count, char** arguments) {
	long value[NUMBERS] = {
		[SEED] = 1, [COUNT] = 1, [STEPS] = 20, [ATTEMPTS] = 5, [CPU] = 20, [MEMORY] = 3072, [FILES] = 64};
	const char* folder = NULL;
	for (int which; (which = getopt_long(count, arguments, "", known, NULL)) != -1;) {
		char* end = NULL;
		if (which >= 0 && which < NUMBERS) value[which] = strtol(optarg, &end, 10);
		if (which == RUN) folder = optarg;
		if (which > RUN || (which != RUN && (*end != '\0' || value[which] < 0))) {
			fputs(usage, stderr);
			return 2;
		}
	}
	if (folder == NULL) {
		random_scene_write((uint64_t)value[SEED], value[INDEX], (int)value[ATTEMPT], stdout);
		return 0;
	}
	return random_scenes_run(&(RunOptions){.seed = value[SEED],
										   .first = value[FIRST],
										   .count = value[COUNT],
										   .steps = value[STEPS],
										   .attempts = value[ATTEMPTS],
										   .cpu = value[CPU],
										   .memory = value[MEMORY],
										   .files = value[FILES],
										   .folder = folder});
}
