/* SPDX-License-Identifier: Apache-2.0 */
/* Called by xrce_routes.c. Internal. */
#ifndef MICROROS_RCUTILS_CONSOLE_HOOKS_H
#define MICROROS_RCUTILS_CONSOLE_HOOKS_H

#ifdef __cplusplus
extern "C" {
#endif

/* Called in each pump: reports dropped messages as soon as the console takes a line, even if nothing more is logged. */
void microros_console_step(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_CONSOLE_HOOKS_H */
