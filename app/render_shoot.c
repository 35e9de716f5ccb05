// GET /api/job tells the page what is wanted; it answers by POST: /api/pictures/<number>, then /api/done, or /api/failure
// with words. All of them carry a key that only the page's address has.
#include "render_shoot.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "base/log.h"
#include "base/timer.h"
#include "browser.h"
#include "interrupt.h"
#include "json.h"
#include "view_page.h"

enum { KEY_BYTES = 16, SILENT_SECONDS = 120, LOOK_MILLISECONDS = 200, NAME_BYTES = 512, URL_BYTES = 2048 };
enum { HTTP_OK = 200, HTTP_FORBIDDEN = 403, HTTP_NOT_FOUND = 404, HTTP_BROKEN = 500 };

typedef struct Shoot {
	const RenderJob* job;
	char key[2 * KEY_BYTES + 1];
	int taken;
	bool is_done;
	JnStatus status;
	double heard; // clock when the page last asked or told something [s]
} Shoot;

// ---- what the page is told ----

static void print_point(FILE* out, const char* name, bool has_it, const double point[3]) {
	fprintf(out, "\"%s\": ", name);
	for (int i = 0; i < 3 && has_it; ++i) {
		fputs(i > 0 ? "," : "[", out);
		json_print_real(out, point[i]);
	}
	fputs(has_it ? "],\n" : "null,\n", out);
}

static void print_job(FILE* out, const RenderJob* job) {
	static const char* const types[] = {"raw", "image/png", "image/jpeg", "image/webp"};
	const char* truth[] = {"false", "true"};
	fputs("{", out);
	json_print_integer_entry(out, "width", job->width);
	json_print_integer_entry(out, "height", job->height);
	json_print_integer_entry(out, "samples", job->samples);
	json_print_text_entry(out, "type", types[job->kind]);
	print_point(out, "eye", job->camera.has_points, job->camera.eye);
	print_point(out, "target", job->camera.has_points, job->camera.target);
	fprintf(out, "\"words\": {\"legend\": %s, \"time\": %s, \"names\": %s},\n\"times\": [", truth[job->has_legend],
			truth[job->has_time], truth[job->has_names]);
	for (int i = 0; i < job->count; ++i) {
		if (i > 0) fputc(',', out);
		json_print_real(out, job->times[i]);
	}
	fputs("]}\n", out);
}

static void answer_job(const RenderJob* job, ViewAnswer* answer) {
	FILE* out = open_memstream(&answer->data, &answer->size);
	if (out == NULL) return;
	print_job(out, job);
	answer->status = fclose(out) == 0 ? HTTP_OK : HTTP_BROKEN;
	answer->type = "application/json";
}

static bool is_known(const Shoot* shoot, const char* key) {
	return key != NULL && strcmp(key, shoot->key) == 0;
}

static void answer(void* user, const char* path, const char* (*query)(void* request, const char* name), void* request,
				   ViewAnswer* answer) {
	Shoot* shoot = user;
	shoot->heard = jn_seconds();
	if (strcmp(path, "/api/job") != 0)
		view_answer(shoot->job->sources, path, query, request, answer);
	else if (is_known(shoot, query(request, "key")))
		answer_job(shoot->job, answer);
	else
		answer->status = HTTP_FORBIDDEN;
}

// ---- what it tells ----

static JnStatus take_picture(Shoot* shoot, int number, const void* body, size_t size) {
	const RenderJob* job = shoot->job;
	if (number != shoot->taken || number >= job->count) return JN_OK; // one that was sent again
	if (size == 0 || (job->kind == RENDER_RAW && size != 4 * (size_t)job->width * (size_t)job->height))
		return jn_error(JN_IO_FAILED, "the browser made a picture of another size than asked; try a smaller --size");
	JN_TRY(job->take(job->user, number, body, size));
	++shoot->taken;
	return JN_OK;
}

static void take(void* user, const char* path, const char* (*query)(void* request, const char* name), void* request,
				 const void* body, size_t size, ViewAnswer* answer) {
	Shoot* shoot = user;
	int number;
	if (!is_known(shoot, query(request, "key"))) {
		answer->status = HTTP_FORBIDDEN;
		return;
	}
	shoot->heard = jn_seconds();
	answer->status = HTTP_OK;
	if (shoot->status != JN_OK) return;
	if (sscanf(path, "/api/pictures/%9d", &number) == 1)
		shoot->status = take_picture(shoot, number, body, size);
	else if (strcmp(path, "/api/done") == 0)
		shoot->is_done = true;
	else if (strcmp(path, "/api/failure") == 0)
		shoot->status = jn_error(JN_IO_FAILED, "the browser cannot draw this: %.*s", (int)(size < 500 ? size : 500),
								 size > 0 ? (const char*)body : "");
	else
		answer->status = HTTP_NOT_FOUND;
}

// ---- the address of the page ----

// Letters, digits and what else is never special; all others as %XX.
static void print_escaped(FILE* out, const char* text) {
	for (; *text != '\0'; ++text) {
		const unsigned char letter = (unsigned char)*text;
		const bool is_plain = (letter | 32) >= 'a' && (letter | 32) <= 'z';
		if (is_plain || (letter >= '0' && letter <= '9') || strchr("-_.", letter) != NULL)
			fputc(letter, out);
		else
			fprintf(out, "%%%02X", letter);
	}
}

static void print_choice(FILE* out, const char* name, const char* value) {
	if (value == NULL) return;
	fprintf(out, "&%s=", name);
	print_escaped(out, value);
}

static void print_address(FILE* out, const Shoot* shoot, int port) {
	const RenderJob* job = shoot->job;
	const RenderCamera* camera = &job->camera;
	fprintf(out, "http://127.0.0.1:%d/?render&shoot=%s&size=%dx%d", port, shoot->key, job->width, job->height);
	print_choice(out, "field", job->field);
	print_choice(out, "map", job->map);
	print_choice(out, "theme", job->theme);
	if (job->has_range) fprintf(out, "&range=%.9g,%.9g", job->range[0], job->range[1]);
	if (camera->has_angles) fprintf(out, "&camera=%.9g,%.9g,%.9g", camera->azimuth, camera->elevation, camera->zoom);
}

// ---- the work ----

static JnStatus make_key(Shoot* shoot) {
	unsigned char bytes[KEY_BYTES];
	if (getrandom(bytes, sizeof bytes, 0) != (ssize_t)sizeof bytes)
		return jn_error(JN_IO_FAILED, "the system gives no random numbers");
	for (int i = 0; i < KEY_BYTES; ++i) snprintf(shoot->key + 2 * (ptrdiff_t)i, 3, "%02x", bytes[i]);
	return JN_OK;
}

static JnStatus tell_silence(const Browser* browser, const char* what) {
	char* words = browser_words(browser);
	const JnStatus status = words != NULL ? jn_error(JN_IO_FAILED, "%s; the last it said:\n%s", what, words)
										  : jn_error(JN_IO_FAILED, "%s", what);
	free(words);
	return status;
}

static JnStatus wait(Shoot* shoot, ViewServer* server, Browser* browser) {
	shoot->heard = jn_seconds();
	while (!shoot->is_done && shoot->status == JN_OK && !app_interrupted) {
		view_server_run(server, LOOK_MILLISECONDS);
		if (shoot->is_done || shoot->status != JN_OK) break;
		if (browser_has_ended(browser))
			return tell_silence(browser, "the browser has ended before the pictures were done");
		if (jn_seconds() - shoot->heard > SILENT_SECONDS)
			return tell_silence(browser, "the browser has done nothing for two minutes; a smaller --size may help");
	}
	return shoot->status;
}

static JnStatus show(Shoot* shoot, ViewServer* server) {
	char url[URL_BYTES] = "";
	Browser browser = {0};
	FILE* out = fmemopen(url, sizeof url - 1, "w");
	if (out == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the page's address");
	print_address(out, shoot, view_server_port(server));
	fclose(out);
	JnStatus status = browser_start(&browser, url);
	if (status == JN_OK) status = wait(shoot, server, &browser);
	browser_stop(&browser);
	return status;
}

JnStatus render_shoot(const RenderJob* job, int* taken) {
	Shoot shoot = {.job = job};
	ViewServer* server = NULL;
	const size_t most = 4 * (size_t)job->width * (size_t)job->height + (1 << 20);
	size_t size;
	*taken = 0;
	if (view_page(&size) == NULL)
		return jn_error(JN_IO_FAILED,
						"this command was built without the viewer's page, which draws; install nodejs and "
						"npm, and build it again (./dev build)");
	JnStatus status = make_key(&shoot);
	const ViewServerOptions options = {.handler = answer, .taker = take, .most_bytes = most, .user = &shoot};
	if (status == JN_OK) status = view_server_start(&options, &server);
	if (status == JN_OK) status = show(&shoot, server);
	view_server_stop(server);
	*taken = shoot.taken;
	return status;
}
