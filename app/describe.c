// jounce describe: the keys of scene files, from the same tables that read them.
#include <stdio.h>
#include <string.h>

#include "app.h"
#include "base/key.h"
#include "jounce/scene.h"

static const char help[] =
	"usage: jounce describe [--markdown] [KEY]\n\n"
	"Explains a key of scene files by its path, such as step.dt or bodies.material, and "
	"the keys below it, or all:\nkind, unit, default, bounds, meaning. --markdown writes tables.";

int app_describe(int count, char** arguments) {
	const char* key = "";
	bool markdown = false;
	for (int i = 1; i < count; ++i) {
		if (strcmp(arguments[i], "--help") == 0 || strcmp(arguments[i], "-h") == 0) return puts(help), EXIT_DONE;
		if (strcmp(arguments[i], "--markdown") == 0)
			markdown = true;
		else if (arguments[i][0] == '-')
			return app_usage_error("describe", "there is no option '%s'", arguments[i]);
		else if (*key != '\0')
			return app_usage_error("describe", "one key at a time; '%s' is one too many", arguments[i]);
		else
			key = arguments[i];
	}
	return app_exit_status(jn_keys_describe(jn_scene_keys, key, markdown, stdout));
}
