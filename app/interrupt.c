#include "interrupt.h"

#include <stddef.h>

volatile sig_atomic_t app_interrupted = 0;

static void on_interrupt(int signal_number) {
	(void)signal_number;
	app_interrupted = 1;
}

void app_catch_interrupts(int flags) {
	const struct sigaction stop = {.sa_handler = on_interrupt, .sa_flags = (int)SA_RESETHAND | flags};
	const struct sigaction ignore = {.sa_handler = SIG_IGN};
	sigaction(SIGINT, &stop, NULL);
	sigaction(SIGTERM, &stop, NULL);
	sigaction(SIGPIPE, &ignore, NULL);
}
