/* SPDX-License-Identifier: Apache-2.0 */
/* No endpoint of this plan takes its samples piece by piece. Internal. */
#ifndef MICROROS_XRCE_SINKS_H
#define MICROROS_XRCE_SINKS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_forward.h"
#include "microros/xrce_read.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline bool xrce_sinks_take(
  const xrce_client_t * client, const xrce_receiver_t * receiver, const xrce_sample_t * sample)
{
  (void)client;
  (void)receiver;
  (void)sample;
  return false;
}

static inline bool xrce_sinks_begin(const xrce_client_t * client, const xrce_arrival_t * arrival)
{
  (void)client;
  (void)arrival;
  return false;
}

static inline bool xrce_sinks_add(
  const xrce_client_t * client, const xrce_arrival_t * arrival, const uint8_t * bytes, size_t size)
{
  (void)client;
  (void)arrival;
  (void)bytes;
  (void)size;
  return false;
}

static inline bool xrce_sinks_end(const xrce_client_t * client, const xrce_arrival_t * arrival, bool complete)
{
  (void)client;
  (void)arrival;
  (void)complete;
  return false;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_SINKS_H */
