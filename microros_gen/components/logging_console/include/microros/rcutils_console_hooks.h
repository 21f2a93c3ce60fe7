/* SPDX-License-Identifier: Apache-2.0 */
/* Called by xrce_routes.c. Internal. */
#ifndef MICROROS_RCUTILS_CONSOLE_HOOKS_H
#define MICROROS_RCUTILS_CONSOLE_HOOKS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the time until microros_console_report is to be called, at most `left`, milliseconds. Where several tasks call
 * the library. */
uint32_t microros_console_left(uint32_t left);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_CONSOLE_HOOKS_H */
