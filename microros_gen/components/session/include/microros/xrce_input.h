/* SPDX-License-Identifier: Apache-2.0 */
/* The buffer that messages of the agent are received into. Only what receives them includes this. */
#ifndef MICROROS_XRCE_INPUT_H
#define MICROROS_XRCE_INPUT_H

#include <stdint.h>

#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Unused between pumps, except for a sample at its end. It is not in the client, so that a changed limit leaves all
 * other sources as they are. */
extern uint8_t xrce_input[MICROROS_INPUT_BUFFER_SIZE];

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_INPUT_H */
