/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_sleep.h"

#include "microros/port.h"
#include "microros/text.h"
#include "microros/xrce_client.h"
#include "microros/xrce_stream_reliable_slots.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_ping_hooks.h"
#include "microros/xrce_wire.h"

uint32_t xrce_sleep_check(uint32_t before, const MICROROS_ANYWHERE uint8_t * bytes, size_t size)
{
  static const uint32_t polynomial = 0xedb88320u;
  uint32_t check = ~before;

  for (size_t i = 0; i < size; ++i) {
    check ^= bytes[i];
    for (uint8_t bit = 0; bit < 8u; ++bit) {
      check = (check >> 1) ^ ((check & 1u) != 0u ? polynomial : 0u);
    }
  }
  return ~check;
}

static uint32_t sleep_check_text(uint32_t before, const MICROROS_ANYWHERE char * text)
{
  return xrce_sleep_check(before, (const MICROROS_ANYWHERE uint8_t *)text, microros_text_size(text) + 1u);
}

static uint32_t sleep_check_number(uint32_t before, uint16_t number)
{
  uint8_t bytes[2];

  xrce_put_le16(bytes, number);
  return xrce_sleep_check(before, bytes, sizeof(bytes));
}

/* Returns a value that distinguishes two entities in one place. */
static uint32_t sleep_identity(const xrce_client_t * client, uint16_t place)
{
  uint32_t check;

  if (xrce_place_is_participant(place)) {
    const xrce_participant_t * participant = &client->participants[place];

    check = sleep_check_text(0, participant->name);
    check = sleep_check_text(check, participant->namespace_);
    return sleep_check_number(check, participant->domain_id);
  }
  const xrce_endpoint_t * endpoint = &client->endpoints[place - MICROROS_NODES_MAX];

  check = sleep_check_text(0, endpoint->name);
  check = sleep_check_text(check, endpoint->type->dds_type_name);
  check = sleep_check_number(check, endpoint->depth);
  check = sleep_check_number(check, endpoint->participant);
  return sleep_check_number(check, endpoint->qos);
}

bool xrce_sleep_can_begin(const xrce_client_t * client)
{
  return client->session.state == (uint8_t)XRCE_READY && xrce_route_settled(client);
}

void xrce_sleep_begin(xrce_client_t * client)
{
  for (uint16_t place = 0; place < (uint16_t)XRCE_PLACES; ++place) {
    xrce_object_state_t * state = &client->states[place];

    if (state->wanted && !state->kept) {
      client->sleep.identity[place] = sleep_identity(client, place);
      state->kept = true;
    }
  }
  client->sleep.local = xrce_sleep_local(&client->session.transport);
  client->sleep.over = true;
  client->session.now_ms = port_time_ms();
}

bool xrce_sleep_is_over(xrce_client_t * client, uint32_t key)
{
  const bool over = client->sleep.over && (key == 0u || client->session.key == key);

  client->sleep.over = false;
  return over;
}

/* The port's time restarts with the device: deadlines keep their distance. */
static void sleep_shift(xrce_client_t * client, uint32_t passed_ms)
{
  client->session.now_ms += passed_ms;
  client->session.received_ms += passed_ms;
  client->entities.due_ms += passed_ms;
  client->entities.requested_ms += passed_ms;
  client->reliable.due_ms += passed_ms;
  client->reliable.since_ms += passed_ms;
}

void xrce_sleep_resume(xrce_client_t * client)
{
  xrce_session_t * session = &client->session;
  const uint32_t now = port_time_ms();

  sleep_shift(client, now - session->now_ms);
  xrce_ping_wake(client, now);
  session->state = (uint8_t)XRCE_READY;
  session->transport_open = xrce_sleep_open(&session->transport, client->sleep.local);
  if (!session->transport_open) {
    xrce_session_mark_lost(client, now);
  }
}

bool xrce_sleep_keeps(const xrce_client_t * client, uint16_t place)
{
  return client->states[place].kept && client->sleep.identity[place] == sleep_identity(client, place);
}

bool xrce_sleep_restore(xrce_client_t * client, uint16_t place)
{
  const bool keeps = xrce_sleep_keeps(client, place);

  client->states[place].kept = false;
  client->sleep.taken = keeps ? (uint16_t)(place + 1u) : 0u;
  return keeps;
}

bool xrce_sleep_was_restored(const xrce_client_t * client, uint16_t place)
{
  return client->sleep.taken == place + 1u;
}

void xrce_sleep_clear(xrce_client_t * client)
{
  for (uint16_t place = 0; place < (uint16_t)XRCE_PLACES; ++place) {
    xrce_object_state_t * state = &client->states[place];

    if (state->kept) {
      state->kept = false;
      state->wanted = false;
      state->stale = false;
      state->level = 0;
    }
  }
}
