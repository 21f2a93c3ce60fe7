/* SPDX-License-Identifier: Apache-2.0 */
/* Where the log writer `console` writes its lines. */
#ifndef MICROROS_PORT_CONSOLE_H
#define MICROROS_PORT_CONSOLE_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes one line, all of it or nothing, and keeps no pointer to it. Returns false if it cannot be written now; the writer
 * counts and reports it. Does not wait for the line, except on a board whose target file names neither an interrupt for
 * its UART nor `provides: [console_send]` (a warning of the build names that board). */
bool port_console_write(const char * line, size_t size);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_CONSOLE_H */
