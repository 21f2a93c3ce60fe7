/* SPDX-License-Identifier: Apache-2.0 */
/* The application of every board in this folder. */
#ifndef EXAMPLES_BOARDS_COUNTER_H
#define EXAMPLES_BOARDS_COUNTER_H

/* Publishes 0, 1, 2 … on /count, ten times a second. Returns when no agent was there at the start, after a second; to be
 * called again then. An agent that goes away later is waited for. */
void counter_run(void);

#endif /* EXAMPLES_BOARDS_COUNTER_H */
