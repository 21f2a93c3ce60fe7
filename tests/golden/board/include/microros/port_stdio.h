/* SPDX-License-Identifier: Apache-2.0 */
/* Connects the output of the C library to its destination. */
#ifndef MICROROS_PORT_STDIO_H
#define MICROROS_PORT_STDIO_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Outputs one byte of stdout or stderr; may wait for the line. Implemented by one of the port's files, or by the application
 * with `stdio: {to: application}`. */
void port_stdio_put(uint8_t byte);

/* A symbol in the file of this port that the C library calls. */
extern const char port_stdio_here;

/* Requests an operation of the debugger (Arm, "Semihosting for AArch32 and AArch64"; RISC-V Semihosting). Implemented by each
 * processor. */
uint32_t port_bare_semihosting(uint32_t operation, const void * argument);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_STDIO_H */
