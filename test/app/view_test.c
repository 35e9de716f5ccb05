// `jounce view`: what its server gives, to whom, and what it says about files that are none.
#define _GNU_SOURCE // memmem
#include <arpa/inet.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "support/support.h"

enum { ANSWER_BYTES = 1 << 22, PATIENCE = 2400 }; // [50 ms]

static const char scene_text[] =
	"name: block\nduration: 0.2 s\nbodies:\n"
	"  - name: block\n"
	"    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}\n"
	"    material: {law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}\n"
	"    fix: [{where: {face: z-}}]\n"
	"integrator: sdirk2\nstep: {controller: fixed, dt: 10 ms}\nrecord: {interval: 20 ms, plots: no}\n";

static char folder[256], answer[ANSWER_BYTES];
static size_t answer_size;
static Process server;
static int port;

// ---- a server, and requests to it ----

static void rest(void) {
	nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
}

static void start(const char* const arguments[]) {
	char words[256] = "";
	server = command_start(folder, arguments);
	port = 0;
	for (int i = 0; i < PATIENCE && port == 0; ++i) {
		const ssize_t length = pread(server.out, words, sizeof words - 1, 0);
		words[length > 0 ? length : 0] = '\0';
		const char* address = strstr(words, "http://127.0.0.1:");
		if (address != NULL && strchr(address + 17, '/') != NULL) port = atoi(address + 17);
		if (port == 0) rest();
	}
	if (port == 0) fail_msg("'jounce view' tells no address, but '%s'", words);
}

#define START(...) start((const char* const[]){"view", "--no-open", __VA_ARGS__, NULL})

// Ctrl-C ends it in order.
static void stop(void) {
	kill(server.id, SIGINT);
	Outcome outcome = command_wait(server);
	if (outcome.status != 0) fail_msg("Ctrl-C ends 'jounce view' with %d: %s", outcome.status, outcome.err);
	outcome_free(&outcome);
}

static int open_socket(const char* address) {
	const struct timeval limit = {.tv_sec = 30};
	struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
	const int id = socket(AF_INET, SOCK_STREAM, 0);
	inet_pton(AF_INET, address, &to.sin_addr);
	setsockopt(id, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
	if (connect(id, (const struct sockaddr*)&to, sizeof to) == 0) return id;
	close(id);
	return -1;
}

// Send a request and read to the end. Returns the status; `answer` holds head and body.
static int ask_with(const char* method, const char* path, const char* headers) {
	char request[1024];
	const int id = open_socket("127.0.0.1");
	assert_true(id >= 0);
	const int length =
		snprintf(request, sizeof request, "%s %s HTTP/1.1\r\n%sConnection: close\r\n\r\n", method, path, headers);
	assert_int_equal(write(id, request, (size_t)length), length);
	answer_size = 0;
	for (ssize_t got; (got = read(id, answer + answer_size, ANSWER_BYTES - 1 - answer_size)) > 0;)
		answer_size += (size_t)got;
	answer[answer_size] = '\0';
	close(id);
	int status = 0;
	sscanf(answer, "HTTP/1.1 %d", &status);
	return status;
}

static int ask(const char* path) {
	char host[64];
	snprintf(host, sizeof host, "Host: 127.0.0.1:%d\r\n", port);
	return ask_with("GET", path, host);
}

static const char* body(void) {
	const char* end = strstr(answer, "\r\n\r\n");
	assert_non_null(end);
	return end + 4;
}

static size_t body_size(void) {
	return answer_size - (size_t)(body() - answer);
}

static void expect_status(int status, int expected, const char* what) {
	if (status != expected) fail_msg("%s is answered with %d, expected %d: %.300s", what, status, expected, answer);
}

static void expect_part(const char* part) {
	if (memmem(answer, answer_size, part, strlen(part)) == NULL) fail_msg("'%s' is not in: %.400s", part, body());
}

// ---- who is answered ----

static void strangers_are_refused(void** state) {
	(void)state;
	static const struct {
		const char *method, *format; // %d: the port
		int status;
	} cases[] = {
		{"GET", "Host: 127.0.0.1:%d\r\n", 200},
		{"GET", "Host: localhost:%d\r\n", 200},
		{"HEAD", "Host: localhost:%d\r\n", 200},
		{"GET", "Host: 127.0.0.1:%d\r\nOrigin: http://127.0.0.1:%d\r\n", 200},
		{"GET", "Host: evil.example:%d\r\n", 403},
		{"GET", "Host: 127.0.0.1.evil.example:%d\r\n", 403},
		{"GET", "Host: 127.0.0.1\r\n", 403},
		{"GET", "Host: 192.168.0.1:%d\r\n", 403},
		{"GET", "Host: 127.0.0.1:%d\r\nOrigin: http://evil.example\r\n", 403},
		{"GET", "Host: 127.0.0.1:%d\r\nOrigin: https://127.0.0.1:%d\r\n", 403},
		{"GET", "Host: 127.0.0.1:%d\r\nOrigin: null\r\n", 403},
		{"GET", "Host: 127.0.0.1:%d\r\nSec-Fetch-Site: cross-site\r\n", 403},
		{"GET", "", 403},
		{"POST", "Host: 127.0.0.1:%d\r\nContent-Length: 0\r\n", 405},
		{"DELETE", "Host: 127.0.0.1:%d\r\n", 405},
		{"OPTIONS", "Host: 127.0.0.1:%d\r\n", 405},
	};
	START("block");
	for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
		char headers[256];
		snprintf(headers, sizeof headers, cases[i].format, port, port); // NOLINT: the formats are those above
		expect_status(ask_with(cases[i].method, "/", headers), cases[i].status, headers);
	}
	stop();
}

static void only_the_loopback_address_listens(void** state) {
	(void)state;
	START("block");
	assert_int_equal(open_socket("127.0.0.2"), -1); // this machine, too, but another address
	stop();
}

static void only_names_of_the_table_are_served(void** state) {
	(void)state;
	static const char* const paths[] = {"/index.html",
										"/../../../../etc/passwd",
										"/%2e%2e/%2e%2e/etc/passwd",
										"/run.h5",
										"/block/run.h5",
										"//",
										"/api",
										"/api/runs/",
										"/api/runs/1",
										"/api/runs/-1",
										"/api/runs/99999999999",
										"/api/runs/0/",
										"/api/runs/0x",
										"/api/runs/0/frames",
										"/api/runs/0/frames/11",
										"/api/runs/0/frames/-1",
										"/api/runs/0/frames/1x",
										"/api/runs/0/frames/99999999999999",
										"/api/runs/0/fields/position/0",
										"/api/runs/0/fields/..%2f..%2fscene/0",
										"/api/runs/0/fields/speed/11",
										"/api/runs/0/fields/speed",
										"/api/runs/0/fields/none/0",
										"/api/runs/0/frames/0/../../../../etc/passwd"};
	START("block");
	for (size_t i = 0; i < sizeof paths / sizeof *paths; ++i) expect_status(ask(paths[i]), 404, paths[i]);
	stop();
}

// ---- what is answered ----

static void a_run_is_served_piece_by_piece(void** state) {
	enum { POINTS = 26 }; // of 27 nodes, the one inside is not drawn
	(void)state;
	START("block");
	expect_status(ask("/api/runs"), 200, "the list");
	expect_part("\"name\": \"block\"");
	expect_status(ask("/api/runs/0"), 200, "a run");
	assert_memory_equal(body(), "JNPK", 4);
	expect_part("\"point_count\": 26");
	expect_part("\"frame_count\": 11");
	expect_part("\"outcome\": \"done\"");
	expect_status(ask("/api/runs/0/state?known=9"), 200, "the state");
	expect_part("\"times\": [0.18");
	expect_status(ask("/api/runs/0/series"), 200, "the series");
	expect_part("specific_error");
	for (int frame = 0; frame < 11; frame += 10) {
		static const char* const fields[] = {"speed", "stress", "strain_energy_density"};
		char path[80];
		snprintf(path, sizeof path, "/api/runs/0/frames/%d", frame);
		expect_status(ask(path), 200, path);
		assert_int_equal(body_size(), POINTS * 3 * sizeof(float));
		for (int i = 0; i < 3; ++i) {
			float first;
			snprintf(path, sizeof path, "/api/runs/0/fields/%s/%d", fields[i], frame);
			expect_status(ask(path), 200, path);
			assert_int_equal(body_size(), POINTS * sizeof(float));
			memcpy(&first, body() + (POINTS - 1) * sizeof first, sizeof first); // a free corner: at rest at first
			// 1e5 Pa times some roundings of F, 1.1e-16 each; its square for the energy; nothing moves yet.
			assert_true(frame == 0 ? fabsf(first) <= 1e-10f : first > 1e-9f);
		}
	}
	stop();
}

static void write_half(const char* name) {
	char* whole = malloc(1 << 20);
	FILE* from = fopen(path_join(folder, "block/run.h5"), "rb");
	assert_non_null(from);
	const size_t size = fread(whole, 1, 1 << 20, from);
	fclose(from);
	mkdir(path_join(folder, name), 0777);
	FILE* to = fopen(path_join(path_join(folder, name), "run.h5"), "wb");
	assert_int_equal(fwrite(whole, 1, size / 2, to), size / 2);
	fclose(to);
	free(whole);
}

static void files_that_are_no_recordings_get_a_message(void** state) {
	(void)state;
	write_half("half");
	mkdir(path_join(folder, "foreign"), 0777);
	file_write(path_join(folder, "foreign/run.h5"), "these are no data\n");
	START("half", "foreign", "nowhere", "block");
	expect_status(ask("/api/runs"), 200, "the list");
	expect_part("half/run.h5: is cut off");
	expect_part("foreign/run.h5: is no HDF5 file");
	expect_part("nowhere/run.h5: there is no such file");
	expect_status(ask("/api/runs/0"), 503, "a run that is cut off");
	expect_status(ask("/api/runs/3/frames/0"), 200, "the whole run beside them");
	stop();
}

// ---- scenes, and saved pages ----

static void a_scene_runs_while_it_is_viewed(void** state) {
	(void)state;
	START("block.yaml", "-o", "live", "--set", "duration=0.3s", "--threads", "1");
	bool is_done = false;
	for (int i = 0; i < PATIENCE && !is_done; ++i) {
		rest();
		if (ask("/api/runs/0/state") != 200) continue; // it is being set up, or written at this moment
		is_done = memmem(answer, answer_size, "\"outcome\": \"done\"", 17) != NULL;
	}
	assert_true(is_done);
	expect_part("\"frame_count\": 16");
	stop();
	assert_true(path_exists(path_join(folder, "live/summary.json")));
}

static Outcome run_view(int expected, const char* const arguments[]) {
	const Outcome outcome = command_run(folder, arguments);
	if (outcome.status != expected)
		fail_msg("'jounce view %s' ends with %d, expected %d: %s", arguments[1], outcome.status, expected, outcome.err);
	return outcome;
}

#define VIEW(expected, ...) run_view(expected, (const char* const[]){"view", __VA_ARGS__, NULL})

static void a_saved_page_holds_the_frames_that_its_limit_allows(void** state) {
	(void)state;
	Outcome outcome = VIEW(0, "block", "--save", "page.html");
	assert_non_null(strstr(outcome.out, "wrote page.html"));
	assert_null(strstr(outcome.out, "of 11 frames"));
	char* page = file_read(path_join(folder, "page.html"));
	assert_non_null(strstr(page, "id=\"0/frames/10\""));
	assert_non_null(strstr(page, "id=\"0/fields/stress/10\""));
	assert_non_null(strstr(page, "</html>"));
	free(page);
	outcome_free(&outcome);
}

static void a_recording_is_also_named_by_its_file(void** state) {
	(void)state;
	Outcome outcome = VIEW(0, "block/run.h5", "--save", "file.html");
	char* page = file_read(path_join(folder, "file.html"));
	assert_non_null(strstr(page, "id=\"0/frames/10\""));
	free(page);
	outcome_free(&outcome);
}

static void a_scene_is_run_and_saved(void** state) {
	(void)state;
	Outcome outcome = VIEW(0, "block.yaml", "-o", "saved", "--save", "scene.html");
	assert_non_null(strstr(outcome.out, "wrote scene.html"));
	char* page = file_read(path_join(folder, "scene.html"));
	assert_non_null(strstr(page, "id=\"0/frames/10\""));
	free(page);
	outcome_free(&outcome);
}

// A plate of points that nothing holds breaks nowhere; the ball beside it is of no points that bonds hold.
static void what_no_bond_holds_has_no_damage(void** state) {
	enum { PLATE = 8 };
	(void)state;
	file_write(
		path_join(folder, "bonds.yaml"),
		"name: bonds\nduration: 1 ms\nbodies:\n"
		"  - name: plate\n    shape: {type: points_box, size: [0.02, 0.02, 0.02], spacing: 1 cm}\n"
		"    material: {law: peridynamic, density: 1200, young: 1e8, fracture_energy: 8}\n"
		"  - name: ball\n    shape: {type: rigid_sphere, center: [1, 0, 0], radius: 1 cm}\n"
		"    material: {law: rigid, density: 7800}\n"
		"fracture: {}\nrepulsion: {}\nintegrator: sdirk2\nstep: {controller: fixed, dt: 1 ms}\nrecord: {plots: no}\n");
	Outcome outcome = command_run(folder, (const char* const[]){"run", "bonds.yaml", "-o", "bonds", "-q", NULL});
	if (outcome.status != 0) fail_msg("the run ends with %d: %s", outcome.status, outcome.err);
	outcome_free(&outcome);
	START("bonds");
	expect_status(ask("/api/runs/0/fields/damage/0"), 200, "the damage");
	assert_true(body_size() / sizeof(float) > PLATE);
	for (size_t i = 0; i < body_size() / sizeof(float); ++i) {
		float damage;
		memcpy(&damage, body() + i * sizeof damage, sizeof damage);
		assert_true(i < PLATE ? damage == 0 : damage == -1e30f);
	}
	stop();
}

static void what_cannot_be_done_is_said(void** state) {
	(void)state;
	static const struct {
		int status;
		const char *arguments[6], *words;
	} cases[] = {
		{2, {"view"}, "nothing to view"},
		{2, {"view", "block", "--port", "70000"}, "--port"},
		{2, {"view", "block", "--host", "nowhere"}, "'nowhere' is no address"},
		{2, {"view", "block", "--sve", "x"}, "did you mean '--save'"},
		{2, {"view", "block.yaml", "block"}, "one scene at a time"},
		{2, {"view", "block.yaml", "--set", "duratio=1"}, "duratio"},
		{3, {"view", "nowhere.yaml"}, "nowhere.yaml: cannot be opened"},
		{3, {"view", "nowhere", "--save", "x.html"}, "no such file"},
		{3, {"view", "nowhere/run.h5", "--save", "x.html"}, "nowhere/run.h5: there is no such file"},
		{3, {"view", "foreign/run.h5", "--save", "x.html"}, "foreign/run.h5: is no HDF5 file"},
		{3, {"view", "half/run.h5", "--save", "x.html"}, "half/run.h5: is cut off"},
		{3, {"view", "block", "block.yaml", "--save", "x.html"}, "block.yaml: is no folder"},
		{3, {"view", "block", "--save", "nowhere/x.html"}, "nowhere/x.html"},
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
		Outcome outcome = run_view(cases[i].status, cases[i].arguments);
		if (strstr(outcome.err, cases[i].words) == NULL) fail_msg("'%s' is not in: %s", cases[i].words, outcome.err);
		outcome_free(&outcome);
	}
}

static int set_up(void** state) {
	(void)state;
	return folder_create_with_run(folder, scene_text);
}

static int tear_down(void** state) {
	(void)state;
	folder_remove(folder);
	return 0;
}

int main(void) {
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(strangers_are_refused),
		cmocka_unit_test(only_the_loopback_address_listens),
		cmocka_unit_test(only_names_of_the_table_are_served),
		cmocka_unit_test(a_run_is_served_piece_by_piece),
		cmocka_unit_test(files_that_are_no_recordings_get_a_message),
		cmocka_unit_test(a_scene_runs_while_it_is_viewed),
		cmocka_unit_test(a_saved_page_holds_the_frames_that_its_limit_allows),
		cmocka_unit_test(a_recording_is_also_named_by_its_file),
		cmocka_unit_test(a_scene_is_run_and_saved),
		cmocka_unit_test(what_no_bond_holds_has_no_damage),
		cmocka_unit_test(what_cannot_be_done_is_said),
	};
#ifdef JN_HAS_PAGE
	return cmocka_run_group_tests(tests, set_up, tear_down);
#else
	(void)tests, (void)set_up, (void)tear_down;
	puts("skipped: this build has no page (it needs Node and `npm ci` in web/)");
	return 77;
#endif
}
