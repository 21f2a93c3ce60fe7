/* SPDX-License-Identifier: Apache-2.0 */
/* Endpoints that a component opens by itself, found in the plan without their names. Internal. */
#ifndef MICROROS_RMW_DECLARED_H
#define MICROROS_RMW_DECLARED_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/flash.h"
#include "microros/xrce_objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Looks for the first endpoint from index *at on, and before `end`, that the node of `wanted` has with this type: a
 * component declares its endpoints in the order in which it opens them, and before those of the application. `end` is that of
 * the endpoints of this kind. Fills in name and index of `wanted`, and makes *at the index after it. Returns whether it
 * exists and is free. */
bool rmw_declared_take(
  xrce_endpoint_t * wanted, uint16_t * at, uint16_t end, const MICROROS_FLASH char * dds_type);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_DECLARED_H */
