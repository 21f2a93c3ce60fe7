/* SPDX-License-Identifier: Apache-2.0 */
/* Between the C library's output and where it goes. */
#ifndef MICROROS_PORT_STDIO_H
#define MICROROS_PORT_STDIO_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Puts out one byte of stdout or stderr, and may wait for its line. One of the port's files has it, or the application with
 * `stdio: {to: application}`. */
void port_stdio_put(uint8_t byte);

/* A mark in the file of this port that the C library calls. */
extern const char port_stdio_here;

/* Asks the debugger for an operation (Arm, "Semihosting for AArch32 and AArch64"; RISC-V Semihosting). Each port has its own. */
uint32_t port_bare_semihosting(uint32_t operation, const void * argument);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_STDIO_H */
