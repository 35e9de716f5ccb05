/// @file browser.h
/// Chromium without a window, for one page of this process. It draws by itself (SwiftShader), so that pictures need neither
/// a display nor a graphics card, and are the same on every machine.
#ifndef JN_APP_BROWSER_H
#define JN_APP_BROWSER_H

#include <stdbool.h>
#include <sys/types.h>

#include "record/text_file.h"

typedef struct Browser {
	pid_t process;             ///< 0: none
	char folder[JN_PATH_SIZE]; ///< its profile and its words; "" when there is none
} Browser;

/// Is there one? JOUNCE_BROWSER names another than those that are looked for in PATH. `path` of JN_PATH_SIZE bytes.
bool browser_find(char* path);

/// Show a page. JN_IO_FAILED, after a message that says what to install, when it cannot be started. To be stopped in any
/// case.
JnStatus browser_start(Browser* browser, const char* url);

/// Has it ended by itself, such as by a crash?
bool browser_has_ended(Browser* browser);

/// The last lines of what it said, to be freed; NULL: nothing.
char* browser_words(const Browser* browser);

/// End it, with all of its processes, and remove its folder.
void browser_stop(Browser* browser);

#endif
