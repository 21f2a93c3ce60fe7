/* SPDX-License-Identifier: Apache-2.0 */
/* Settings of NuttX that the port asks for: for a check of its syntax, not of what it does. */
#ifndef STAND_IN_NUTTX_CONFIG_H
#define STAND_IN_NUTTX_CONFIG_H

#define CONFIG_PRIORITY_INHERITANCE 1
#define CONFIG_PTHREAD_MUTEX_TYPES 1
#define CONFIG_PIPES 1
#define CONFIG_SERIAL_TERMIOS 1
#define CONFIG_TLS_NELEM 1
#define CONFIG_BOARDCTL_RESET_CAUSE 1
#define CONFIG_BOARDCTL_UNIQUEID 1
#define CONFIG_BOARDCTL_UNIQUEID_SIZE 16
#ifdef KERNEL_CORES /* of the checks, one has stacks that the kernel fills */
#define CONFIG_STACK_COLORATION 1
#endif

#endif /* STAND_IN_NUTTX_CONFIG_H */
