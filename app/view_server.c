// libmicrohttpd without threads: HDF5 is not made for more than one.
#include "view_server.h"

#include <arpa/inet.h>
#include <microhttpd.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/log.h"

enum { IDLE_SECONDS = 60, CONNECTIONS = 32, BUFFER_BYTES = 1 << 20 };

struct ViewServer {
	struct MHD_Daemon* daemon;
	ViewHandler* handler;
	ViewTaker* taker;
	size_t most_bytes;
	void* user;
	int port;
	bool is_open; // listens beyond the loopback address, as asked
	char host[64];
};

// ---- who may ask ----

static bool names(const char* word, const char* host, int port) {
	char full[128];
	snprintf(full, sizeof full, "%s:%d", host, port);
	return strcmp(word, full) == 0 || (port == 80 && strcmp(word, host) == 0);
}

// An address in numbers cannot be rebound to another machine.
static bool is_number(const char* word, int port) {
	char host[64];
	struct in_addr address;
	const char* colon = strrchr(word, ':');
	const size_t length = colon != NULL ? (size_t)(colon - word) : strlen(word);
	if (length >= sizeof host || (colon != NULL && atoi(colon + 1) != port)) return false;
	memcpy(host, word, length);
	host[length] = '\0';
	return inet_pton(AF_INET, host, &address) == 1;
}

static bool is_ours(const ViewServer* server, const char* word) {
	if (word == NULL) return false;
	return names(word, "127.0.0.1", server->port) || names(word, "localhost", server->port) ||
		   names(word, server->host, server->port) || (server->is_open && is_number(word, server->port));
}

static bool is_allowed(const ViewServer* server, struct MHD_Connection* connection) {
	static const char scheme[] = "http://";
	const char* host = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, MHD_HTTP_HEADER_HOST);
	const char* origin = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Origin");
	const char* site = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Sec-Fetch-Site");
	if (!is_ours(server, host)) return false;
	if (site != NULL && strcmp(site, "same-origin") != 0 && strcmp(site, "none") != 0) return false;
	return origin == NULL ||
		   (strncmp(origin, scheme, sizeof scheme - 1) == 0 && is_ours(server, origin + sizeof scheme - 1));
}

// ---- answers ----

static const char* find_query(void* request, const char* name) {
	return MHD_lookup_connection_value(request, MHD_GET_ARGUMENT_KIND, name);
}

static enum MHD_Result send_answer(struct MHD_Connection* connection, const ViewAnswer* answer) {
	static const char* const headers[][2] = {
		{"Cache-Control", "no-store"},
		{"X-Content-Type-Options", "nosniff"},
		{"Cross-Origin-Resource-Policy", "same-origin"},
		{"Referrer-Policy", "no-referrer"},
		{"Content-Security-Policy", "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
									"img-src data: blob:; connect-src 'self'; frame-ancestors 'none'"},
	};
	const bool is_constant = answer->page != NULL;
	struct MHD_Response* response =
		is_constant ? MHD_create_response_from_buffer(answer->size, (void*)answer->page, MHD_RESPMEM_PERSISTENT)
					: MHD_create_response_from_buffer(answer->size, answer->data, MHD_RESPMEM_MUST_FREE);
	if (response == NULL) {
		free(answer->data);
		return MHD_NO;
	}
	for (size_t i = 0; i < sizeof headers / sizeof *headers; ++i)
		MHD_add_response_header(response, headers[i][0], headers[i][1]);
	MHD_add_response_header(response, MHD_HTTP_HEADER_CONTENT_TYPE, answer->type);
	if (answer->status == MHD_HTTP_METHOD_NOT_ALLOWED) MHD_add_response_header(response, "Allow", "GET, HEAD");
	const enum MHD_Result result = MHD_queue_response(connection, (unsigned)answer->status, response);
	MHD_destroy_response(response);
	return result;
}

static ViewAnswer refuse(int status, const char* words) {
	return (ViewAnswer){.status = status, .type = "text/plain; charset=utf-8", .page = words, .size = strlen(words)};
}

// ---- requests ----

// What has come of one request.
typedef struct Request {
	size_t size, room;
	char* body;
	bool is_refused; // the body is too long, or there is no memory for it
} Request;

static void keep_part(const ViewServer* server, Request* request, const char* part, size_t size) {
	const size_t needed = request->size + size;
	if (server->taker == NULL || needed > server->most_bytes) request->is_refused = true;
	if (!request->is_refused && needed > request->room) {
		const size_t room = needed > 2 * request->room ? needed : 2 * request->room;
		char* larger = realloc(request->body, room);
		request->is_refused = larger == NULL;
		if (larger != NULL) request->body = larger, request->room = room;
	}
	if (request->is_refused) return;
	memcpy(request->body + request->size, part, size);
	request->size = needed;
}

static void answer_request(ViewServer* server, struct MHD_Connection* connection, const char* path, const char* method,
						   const Request* request, ViewAnswer* answer) {
	const bool is_post = strcmp(method, "POST") == 0;
	if (!is_allowed(server, connection))
		*answer = refuse(MHD_HTTP_FORBIDDEN, "jounce view: refused: this is not the page's own address\n");
	else if (is_post && server->taker != NULL && request->is_refused)
		*answer = refuse(MHD_HTTP_CONTENT_TOO_LARGE, "jounce view: refused: this is too long\n");
	else if (is_post && server->taker != NULL)
		server->taker(server->user, path, find_query, connection, request->body, request->size, answer);
	else if (strcmp(method, "GET") != 0 && strcmp(method, "HEAD") != 0)
		*answer = refuse(MHD_HTTP_METHOD_NOT_ALLOWED, "jounce view: refused: pages and data can only be read\n");
	else
		server->handler(server->user, path, find_query, connection, answer);
}

static enum MHD_Result on_request(void* user, struct MHD_Connection* connection, const char* path, const char* method,
								  const char* version, const char* body, size_t* body_size, void** state) {
	ViewServer* server = user;
	ViewAnswer answer = {.status = MHD_HTTP_NOT_FOUND, .type = "text/plain"};
	(void)version;
	if (*state == NULL) { // an answer before all of the request is read would end the connection
		*state = calloc(1, sizeof(Request));
		return *state != NULL ? MHD_YES : MHD_NO;
	}
	if (*body_size > 0) {
		keep_part(server, *state, body, *body_size);
		*body_size = 0;
		return MHD_YES;
	}
	answer_request(server, connection, path, method, *state, &answer);
	return send_answer(connection, &answer);
}

static void on_end(void* user, struct MHD_Connection* connection, void** state, enum MHD_RequestTerminationCode code) {
	Request* request = *state;
	(void)user, (void)connection, (void)code;
	if (request != NULL) free(request->body);
	free(request);
	*state = NULL;
}

// ---- life ----

JnStatus view_server_start(const ViewServerOptions* options, ViewServer** out) {
	struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)options->port)};
	const char* host = options->host != NULL ? options->host : "127.0.0.1";
	*out = NULL;
	if (inet_pton(AF_INET, strcmp(host, "localhost") == 0 ? "127.0.0.1" : host, &address.sin_addr) != 1)
		return jn_error(JN_BAD_INPUT, "--host: '%s' is no address such as 127.0.0.1 or 0.0.0.0", host);
	ViewServer* server = calloc(1, sizeof *server);
	if (server == NULL) return jn_error(JN_OUT_OF_MEMORY, "out of memory: no room for the server");
	server->handler = options->handler;
	server->taker = options->taker;
	server->most_bytes = options->most_bytes;
	server->user = options->user;
	server->is_open = ntohl(address.sin_addr.s_addr) >> 24 != 127;
	snprintf(server->host, sizeof server->host, "%s", host);
	server->daemon = MHD_start_daemon(MHD_NO_FLAG, (uint16_t)options->port, NULL, NULL, on_request, server,
									  MHD_OPTION_SOCK_ADDR, &address, MHD_OPTION_CONNECTION_TIMEOUT, IDLE_SECONDS,
									  MHD_OPTION_CONNECTION_LIMIT, CONNECTIONS, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
									  (size_t)BUFFER_BYTES, MHD_OPTION_NOTIFY_COMPLETED, on_end, NULL, MHD_OPTION_END);
	const union MHD_DaemonInfo* info =
		server->daemon != NULL ? MHD_get_daemon_info(server->daemon, MHD_DAEMON_INFO_BIND_PORT) : NULL;
	if (info == NULL) {
		view_server_stop(server);
		return jn_error(JN_IO_FAILED, "cannot listen at %s, port %d; try another --port, or none for any that is free",
						host, options->port);
	}
	server->port = info->port;
	*out = server;
	return JN_OK;
}

int view_server_port(const ViewServer* server) {
	return server->port;
}

void view_server_run(ViewServer* server, int milliseconds) {
	MHD_run_wait(server->daemon, milliseconds);
}

void view_server_stop(ViewServer* server) {
	if (server == NULL) return;
	if (server->daemon != NULL) MHD_stop_daemon(server->daemon);
	free(server);
}
