/* SPDX-License-Identifier: Apache-2.0 */
/* The counters of the session on /diagnostics. */
#ifndef SESSION_DIAGNOSTICS__SESSION_DIAGNOSTICS_H_
#define SESSION_DIAGNOSTICS__SESSION_DIAGNOSTICS_H_

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Lets the executor publish the counters when it next runs, and not when their period is over.
 *
 * Call it from the task that runs the executor. Nothing happens while no node is open.
 */
void session_diagnostics_now(void);

#ifdef __cplusplus
}
#endif

#endif /* SESSION_DIAGNOSTICS__SESSION_DIAGNOSTICS_H_ */
