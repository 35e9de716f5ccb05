/// @file view_server.h
/// A small HTTP server for one page on this machine. It answers only requests that name it by its own address (a foreign
/// name in Host is how a page elsewhere would reach it by DNS rebinding) and that come from its own page.
#ifndef JN_APP_VIEW_SERVER_H
#define JN_APP_VIEW_SERVER_H

#include <stddef.h>

#include "jounce/base.h"

typedef struct ViewAnswer {
	int status;       ///< of HTTP: 200, 404, ...
	const char* type; ///< media type
	char* data;       ///< malloc'ed, freed by the server; NULL: nothing
	const char* page; ///< constant bytes instead of data; NULL: data
	size_t size;
} ViewAnswer;

/// Answer a GET of `path`, which begins with '/' and has no query; `query` gives its parameters by name, or NULL.
typedef void ViewHandler(void* user, const char* path, const char* (*query)(void* request, const char* name),
						 void* request, ViewAnswer* answer);

/// Take the body of a POST, which is gone afterwards.
typedef void ViewTaker(void* user, const char* path, const char* (*query)(void* request, const char* name),
					   void* request, const void* body, size_t size, ViewAnswer* answer);

typedef struct ViewServer ViewServer;

typedef struct ViewServerOptions {
	const char* host; ///< IPv4 address to listen at; NULL: 127.0.0.1
	int port;         ///< 0: any that is free
	ViewHandler* handler;
	ViewTaker* taker;  ///< NULL: a POST is refused
	size_t most_bytes; ///< of the body of a POST
	void* user;
} ViewServerOptions;

/// Listen. JN_BAD_INPUT for an address that is none, JN_IO_FAILED when it cannot be used, after a message.
JnStatus view_server_start(const ViewServerOptions* options, ViewServer** server);
int view_server_port(const ViewServer* server);

/// Answer requests for at most this long [ms]; returns early after an event.
void view_server_run(ViewServer* server, int milliseconds);
void view_server_stop(ViewServer* server);

#endif
