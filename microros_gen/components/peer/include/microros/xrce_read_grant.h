/* SPDX-License-Identifier: Apache-2.0 */
/* How many samples a reliable receiver requests: those of links have room besides. Internal. */
#ifndef MICROROS_XRCE_READ_GRANT_H
#define MICROROS_XRCE_READ_GRANT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns how many samples the `index`-th receiver requests whose queue has room for `room`: without room for all requests
 * that clients of other boards may have under way. */
uint16_t xrce_read_grant(uint16_t index, uint16_t room);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_READ_GRANT_H */
