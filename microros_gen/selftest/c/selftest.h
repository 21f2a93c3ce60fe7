/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Self-test of the library on its own board: the port's functions, and a round trip of each selected message type.
 * Static memory only. Not part of the library: an image of the application does not contain it.
 */
#ifndef SELFTEST_H
#define SELFTEST_H

#include <stdbool.h>
#include <stdint.h>

#include "selftest_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Runs all checks, in less than 5 s, and returns how many failed. Each prints a line: `PASS name`, `FAIL name: seen …
 * expected …` or `SKIP name: why`; the last line is `PASS n of n` or `FAIL k of n`, without those that were skipped.
 * Called once, from main or from a task of the application, when the network is up and nothing else uses the library.
 */
uint32_t selftest_run(void);

/* Prints a line; `text` is without its end. selftest_console.c prints to standard output: leave that file out to define
 * the function yourself. Called by the task that called selftest_run. */
void selftest_line(const char * text);

/* Takes the link (a network, a serial line or a bus) down or up, and returns when it is: a switch, or a person at the cable. The
 * application defines it where the self-test is compiled with -DSELFTEST_LINK. Called by the task that called
 * selftest_run. */
void selftest_set_link(bool is_up);

#ifdef __cplusplus
}
#endif

#endif /* SELFTEST_H */
