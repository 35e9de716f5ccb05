/// @file interrupt.h
/// Ctrl-C and SIGTERM: the first asks to finish what is at hand, a second one ends the process at once.
#ifndef JN_APP_INTERRUPT_H
#define JN_APP_INTERRUPT_H

#include <signal.h>

/// Set once the first has come, and for good.
extern volatile sig_atomic_t app_interrupted;

/// Wait for them from now on. SIGPIPE is ignored: a reader of stdout that goes away (`jounce run ... | head`) ends nothing.
/// `flags` of sigaction, beside SA_RESETHAND: SA_RESTART, or 0 for those who wait in system calls.
void app_catch_interrupts(int flags);

#endif
