#define _GNU_SOURCE // nftw
#include "browser.h"

#include <errno.h>
#include <ftw.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/log.h"
#include "compare_files.h"
#include "compare_process.h"

enum { OPEN_FOLDERS = 16, WORDS_BYTES = 600, MOST_FLAGS = 40 };

static const char* const names[] = {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"};

// Pictures do not depend on the machine's screen, fonts' hints or graphics card; nothing is asked of the network.
static const char* const flags[] = {
	"--headless",
	"--use-angle=swiftshader",
	"--enable-unsafe-swiftshader",
	"--ignore-gpu-blocklist",
	"--force-color-profile=srgb",
	"--force-device-scale-factor=1",
	"--disable-lcd-text",
	"--font-render-hinting=none",
	"--disable-dev-shm-usage",
	"--disable-breakpad",
	"--disable-extensions",
	"--disable-sync",
	"--disable-background-networking",
	"--disable-component-update",
	"--disable-default-apps",
	"--no-default-browser-check",
	"--no-first-run",
	"--no-proxy-server",
	"--mute-audio",
	"--password-store=basic",
};

static bool find_in_path(const char* name, char* path) {
	const char* folders = getenv("PATH");
	for (const char* at = folders != NULL ? folders : ""; *at != '\0';) {
		const int length = (int)strcspn(at, ":");
		snprintf(path, JN_PATH_SIZE, "%.*s/%s", length, at, name);
		if (length > 0 && access(path, X_OK) == 0) return true;
		at += length + (at[length] == ':');
	}
	return false;
}

bool browser_find(char* path) {
	const char* chosen = getenv("JOUNCE_BROWSER");
	if (chosen != NULL && strchr(chosen, '/') != NULL) {
		snprintf(path, JN_PATH_SIZE, "%s", chosen);
		return access(path, X_OK) == 0;
	}
	if (chosen != NULL) return find_in_path(chosen, path);
	for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
		if (find_in_path(names[i], path)) return true;
	return false;
}

static JnStatus make_folder(Browser* browser) {
	const char* place = getenv("TMPDIR");
	snprintf(browser->folder, sizeof browser->folder, "%s/jounce-XXXXXX", place != NULL ? place : "/tmp");
	if (mkdtemp(browser->folder) != NULL) return JN_OK;
	const JnStatus status = jn_error(JN_IO_FAILED, "%s: %s; TMPDIR names another place for what the browser needs",
									 browser->folder, strerror(errno));
	browser->folder[0] = '\0';
	return status;
}

static JnStatus start(Browser* browser, const char* program, const char* url) {
	char profile[JN_PATH_SIZE + 32], log[JN_PATH_SIZE];
	const char* arguments[MOST_FLAGS] = {program};
	int count = 1;
	JN_TRY(make_folder(browser));
	JN_TRY(jn_path_join(browser->folder, "words", log));
	snprintf(profile, sizeof profile, "--user-data-dir=%s/profile", browser->folder);
	for (size_t i = 0; i < sizeof flags / sizeof *flags; ++i) arguments[count++] = flags[i];
	if (geteuid() == 0) arguments[count++] = "--no-sandbox"; // Chromium has none for root
	arguments[count++] = profile;
	arguments[count++] = url;
	browser->process = compare_process_start(program, arguments, NULL, log);
	if (browser->process > 0) return JN_OK;
	browser->process = 0;
	return jn_error(JN_IO_FAILED, "%s: cannot be started: %s", program, strerror(errno));
}

JnStatus browser_start(Browser* browser, const char* url) {
	char program[JN_PATH_SIZE];
	*browser = (Browser){0};
	if (browser_find(program)) return start(browser, program, url);
	const char* chosen = getenv("JOUNCE_BROWSER");
	if (chosen != NULL) return jn_error(JN_IO_FAILED, "JOUNCE_BROWSER: there is no program '%s'", chosen);
	return jn_error(JN_IO_FAILED,
					"pictures are drawn by Chromium, which is not there; Debian: apt-get install chromium. Another "
					"program of its kind is named by JOUNCE_BROWSER=/path/to/it");
}

bool browser_has_ended(Browser* browser) {
	if (browser->process == 0) return true;
	if (waitpid(browser->process, NULL, WNOHANG) != browser->process) return false;
	kill(-browser->process, SIGKILL); // what it may have left
	browser->process = 0;
	return true;
}

char* browser_words(const Browser* browser) {
	char log[JN_PATH_SIZE];
	if (browser->folder[0] == '\0' || jn_path_join(browser->folder, "words", log) != JN_OK) return NULL;
	char* text = compare_file_read(log);
	const size_t length = text != NULL ? strlen(text) : 0;
	if (length > WORDS_BYTES) memmove(text, text + length - WORDS_BYTES, WORDS_BYTES + 1);
	if (length > 0) return text;
	free(text);
	return NULL;
}

static int remove_entry(const char* path, const struct stat* facts, int kind, struct FTW* place) {
	(void)facts, (void)kind, (void)place;
	remove(path);
	return 0;
}

void browser_stop(Browser* browser) {
	if (browser->process > 0) {
		kill(-browser->process, SIGKILL);
		compare_process_wait(browser->process);
	}
	if (browser->folder[0] != '\0') nftw(browser->folder, remove_entry, OPEN_FOLDERS, FTW_DEPTH | FTW_PHYS);
	*browser = (Browser){0};
}
