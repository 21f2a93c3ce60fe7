/* SPDX-License-Identifier: Apache-2.0 */
#ifndef PUBLISHER_H
#define PUBLISHER_H

#include <stdbool.h>

/* Publishes a number each second; does not return. `is_stream` and `line` are those of the transport: true and
 * `&huart3`, true and NULL for USB, false and the address of the agent for UDP. Call it in a task with 4 KiB of stack, or
 * at the end of main. */
void microros_publisher(bool is_stream, void * line);

#endif /* PUBLISHER_H */
