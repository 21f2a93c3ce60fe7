/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/xrce_arrivals.h"
#include "microros/xrce_client.h"
#include "microros/xrce_place.h"
#include "microros/xrce_silence_hooks.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

static void silence_end(xrce_silence_t * silence, size_t i)
{
  silence->due_ms = port_time_ms() + xrce_silence_calls[i].after_ms;
  silence->is_silent = false;
}

/* After a sleep the rest of the time continues. What was silent before it is so again, at once: the program has begun again,
 * and the end of the time may be so long ago that it would seem to come. */
static void silence_continue(xrce_silence_t * silence)
{
  if (silence->is_silent) {
    silence->due_ms = port_time_ms();
    silence->is_silent = false;
  }
}

void xrce_silence_opened(const xrce_endpoint_t * endpoint)
{
  xrce_client_t * client = endpoint->client;

  for (size_t i = 0; i < MICROROS_SILENCES; ++i) {
    if (endpoint->index == MICROROS_PUBLISHERS_MAX + xrce_silence_calls[i].receiver) {
      /* cppcheck-suppress knownConditionTrueFalse ; without sleep_cycles nothing is kept */
      if (xrce_place_is_kept(client, (uint16_t)(MICROROS_NODES_MAX + endpoint->index))) {
        silence_continue(&client->silences[i]);
      } else {
        silence_end(&client->silences[i], i);
      }
      client->silences[i].is_open = true;
    }
  }
}

void xrce_silence_before(xrce_client_t * client)
{
  for (size_t i = 0; i < MICROROS_SILENCES; ++i) {
    client->silences[i].before = xrce_arrivals(client, xrce_silence_calls[i].receiver);
  }
}

/* A sample that waited for the program until now was in time: a program that is slow is no silence. */
void xrce_silence_after(xrce_client_t * client)
{
  for (size_t i = 0; i < MICROROS_SILENCES; ++i) {
    if (client->silences[i].before != xrce_arrivals(client, xrce_silence_calls[i].receiver)) {
      silence_end(&client->silences[i], i);
    }
  }
}

void xrce_silence_step(xrce_client_t * client, uint32_t now)
{
  for (size_t i = 0; i < MICROROS_SILENCES; ++i) {
    xrce_silence_t * silence = &client->silences[i];
    const uint16_t place =
      (uint16_t)(MICROROS_NODES_MAX + MICROROS_PUBLISHERS_MAX + xrce_silence_calls[i].receiver);

    if (!client->states[place].wanted) { /* its subscription was finalized */
      silence->is_open = false;
      silence->is_silent = false;
    }
    if (silence->is_open && !silence->is_silent && xrce_is_due(now, silence->due_ms)) {
      silence->is_silent = true;
      xrce_silence_calls[i].call();
    }
  }
}

uint32_t xrce_silence_left(const xrce_client_t * client, uint32_t left, uint32_t now)
{
  uint32_t least = left;

  for (size_t i = 0; i < MICROROS_SILENCES; ++i) {
    const xrce_silence_t * silence = &client->silences[i];

    if (silence->is_open && !silence->is_silent) {
      least = xrce_sooner(least, silence->due_ms, now);
    }
  }
  return least;
}
