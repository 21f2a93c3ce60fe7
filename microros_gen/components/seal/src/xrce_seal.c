/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "microros/xrce_seal_input.h"
#include "microros/xrce_seal_pause.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"

#include <string.h>

enum {
  TYPE_FIRST = 1,
  TYPE_SECOND = 2,
  TYPE_RECORD = 3,
  TYPE_REFUSAL = 4,
  VERSION = 1,
  RECORD_HEAD = 16,
  REFUSAL = 8,
  WINDOW = 32
};

/* A session ends after this many records in one direction, long before a nonce could repeat. */
#define LAST_RECORD 0xffff0000u

uint8_t xrce_seal_record[XRCE_SEAL_LARGEST];

static void seal_put_32(uint8_t * at, uint32_t value)
{
  uint32_t rest = value;

  for (uint8_t i = 0; i < 4u; ++i) {
    at[i] = (uint8_t)(rest & 0xffu);
    rest >>= 8;
  }
}

static uint32_t seal_get_32(const uint8_t * at)
{
  return (uint32_t)at[0] | ((uint32_t)at[1] << 8) | ((uint32_t)at[2] << 16) | ((uint32_t)at[3] << 24);
}

static void seal_put_head(uint8_t * at, uint8_t type, uint32_t index)
{
  at[0] = type;
  at[1] = VERSION;
  at[2] = 0;
  at[3] = 0;
  seal_put_32(&at[4], index);
}

static bool seal_has_head(const uint8_t * at, uint8_t type)
{
  return at[0] == type && at[1] == (uint8_t)VERSION && at[2] == 0u && at[3] == 0u;
}

/* Writes the first message of a new handshake. */
static bool seal_hello(xrce_seal_t * seal)
{
  static const uint8_t label[] = {
    'm', 'i', 'c', 'r', 'o', 'r', 'o', 's', '-', 'g', 'e', 'n', ' ', 's', 'e', 'a', 'l'};
  uint8_t psk[MICROROS_SEAL_KEY];
  uint8_t prologue[sizeof(label) + (size_t)XRCE_SEAL_HELLO];
  uint8_t own[4];
  bool done;

  seal->fault = (uint8_t)XRCE_SEAL_NO_KEY;
  if (!microros_seal_psk(MICROROS_CLIENT_KEY, psk)) {
    xrce_noise_wipe(psk, sizeof(psk)); /* it may have a part of the key */
    return false;
  }
  seal->fault = (uint8_t)XRCE_SEAL_NO_CRYPTO;
  done = microros_seal_random(own, sizeof(own));
  if (done) {
    seal->own = seal_get_32(own);
    seal_put_head(seal->first, TYPE_FIRST, seal->own);
    seal_put_32(&seal->first[8], MICROROS_CLIENT_KEY);
    (void)memcpy(prologue, label, sizeof(label));
    (void)memcpy(&prologue[sizeof(label)], seal->first, XRCE_SEAL_HELLO);
    done = xrce_noise_begin(&seal->noise, psk, prologue, sizeof(prologue), &seal->first[XRCE_SEAL_HELLO]);
  }
  xrce_noise_wipe(psk, sizeof(psk));
  return done;
}

static void seal_clear(xrce_seal_t * seal)
{
  seal->is_ready = false;
  xrce_noise_clear(&seal->noise);
  xrce_noise_wipe(seal->sending, sizeof(seal->sending));
  xrce_noise_wipe(seal->receiving, sizeof(seal->receiving));
}

/* Begins a handshake. Without one, `fault` says why. */
static bool seal_begin(xrce_seal_t * seal)
{
  const uint32_t now = port_time_ms();

  seal_clear(seal);
  seal->since_ms = now;
  seal->due_ms = now;
  if (!seal_hello(seal)) {
    seal_clear(seal);
    return false;
  }
  seal->fault = (uint8_t)XRCE_SEAL_SILENT;
  return true;
}

bool xrce_transport_open(xrce_transport_t * transport)
{
  xrce_seal_t * seal = &transport->seal;

  seal->waiting_size = 0;
  if (!xrce_plain_open(transport)) {
    seal->fault = (uint8_t)XRCE_SEAL_FINE; /* not for a reason of this layer */
    return false;
  }
  if (!seal_begin(seal)) {
    xrce_plain_close(transport);
    return false;
  }
  return true;
}

void xrce_transport_close(xrce_transport_t * transport)
{
  xrce_seal_t * seal = &transport->seal;

  seal_clear(seal);
  xrce_noise_wipe(seal->waiting, sizeof(seal->waiting));
  seal->waiting_size = 0;
  xrce_plain_close(transport);
}

static bool seal_send_record(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  xrce_seal_t * seal = &transport->seal;
  const uint32_t counter = seal->next;

  if (size > (size_t)XRCE_SEAL_LARGEST - (size_t)XRCE_SEAL_OVERHEAD) {
    return false;
  }
  seal_put_head(xrce_seal_record, TYPE_RECORD, seal->peer);
  seal_put_32(&xrce_seal_record[8], counter);
  seal_put_32(&xrce_seal_record[12], 0);
  if (!microros_seal_seal(seal->sending, counter, NULL, 0, message, size, &xrce_seal_record[RECORD_HEAD])) {
    return false;
  }
  seal->next = counter + 1u; /* never used again, even if the transport does not send the record */
  return xrce_plain_send(transport, xrce_seal_record, size + (size_t)XRCE_SEAL_OVERHEAD);
}

/* Sends the first message of the handshake if it is due, at growing intervals. */
static void seal_repeat(xrce_transport_t * transport)
{
  xrce_seal_t * seal = &transport->seal;
  const uint32_t now = port_time_ms();

  if (xrce_is_due(now, seal->due_ms)) {
    seal->due_ms = now + xrce_seal_pause(now - seal->since_ms);
    (void)xrce_plain_send(transport, seal->first, sizeof(seal->first)); /* repeated if lost or refused */
  }
}

static bool seal_keep(xrce_seal_t * seal, const uint8_t * message, size_t size)
{
  if (size > sizeof(seal->waiting)) {
    return false;
  }
  (void)memcpy(seal->waiting, message, size); /* at most XRCE_SEAL_WAITING bytes */
  seal->waiting_size = (uint8_t)size;
  return true;
}

/* Returns whether the agent has answered nothing since the handshake: it may have restarted, and forgotten the session. */
static bool seal_is_unanswered(const xrce_seal_t * seal)
{
  return seal->newest == 0u && xrce_is_due(port_time_ms(), seal->due_ms);
}

bool xrce_transport_send(xrce_transport_t * transport, const uint8_t * message, size_t size)
{
  xrce_seal_t * seal = &transport->seal;

  if (seal->is_ready && seal_is_unanswered(seal)) {
    seal->is_ready = false;
    seal->fault = (uint8_t)XRCE_SEAL_FINE; /* begins below */
  }
  if (seal->is_ready && seal->next < LAST_RECORD && seal->newest < LAST_RECORD) {
    return seal_send_record(transport, message, size);
  }
  if ((seal->is_ready || seal->fault <= (uint8_t)XRCE_SEAL_NO_CRYPTO) && !seal_begin(seal)) {
    return false;
  }
  seal_repeat(transport);
  return seal_keep(seal, message, size);
}

static int32_t seal_refuse(xrce_seal_t * seal)
{
  ++seal->refused;
  return -1;
}

/* Returns whether the agent has to answer a handshake. Without one the secrets are zeros, with which anyone can make an
 * answer. */
static bool seal_awaits_answer(const xrce_seal_t * seal)
{
  return !seal->is_ready && seal->fault > (uint8_t)XRCE_SEAL_NO_CRYPTO;
}

/* The second message of the handshake: the session begins. */
static int32_t seal_on_second(xrce_transport_t * transport, const uint8_t * second, size_t size)
{
  xrce_seal_t * seal = &transport->seal;

  if (size != (size_t)XRCE_SEAL_FIRST || seal_get_32(&second[8]) != seal->own) {
    return seal_refuse(seal);
  }
  if (seal->is_ready) {
    return 0; /* the answer to a repetition */
  }
  if (!seal_awaits_answer(seal)) {
    return seal_refuse(seal);
  }
  if (!xrce_noise_finish(&seal->noise, &second[XRCE_SEAL_HELLO], seal->sending, seal->receiving)) {
    seal->fault = (uint8_t)XRCE_SEAL_FORGED;
    return seal_refuse(seal);
  }
  xrce_noise_clear(&seal->noise);
  seal->peer = seal_get_32(&second[4]);
  seal->next = 0;
  seal->newest = 0;
  seal->window = 0;
  seal->is_ready = true;
  seal->due_ms = port_time_ms() + 2u * (uint32_t)MICROROS_RETRY_MOST_MS;
  seal->fault = (uint8_t)XRCE_SEAL_FINE;
  if (seal->waiting_size > 0u) {
    const size_t waiting = seal->waiting_size;

    seal->waiting_size = 0;
    (void)seal_send_record(transport, seal->waiting, waiting); /* whoever sent it repeats it */
  }
  return 0;
}

/* Returns whether a record with this counter may be new. RFC 4303, 3.4.3. */
static bool seal_is_new(const xrce_seal_t * seal, uint32_t counter)
{
  const uint32_t age = seal->newest - 1u - counter;

  if (counter >= seal->newest) {
    return true;
  }
  return age < (uint32_t)WINDOW && ((seal->window >> age) & 1u) == 0u;
}

static void seal_note(xrce_seal_t * seal, uint32_t counter)
{
  if (counter >= seal->newest) {
    const uint32_t ahead = counter - seal->newest + 1u;

    seal->window = ahead < (uint32_t)WINDOW ? seal->window << ahead : 0u;
    seal->window |= 1u;
    seal->newest = counter + 1u;
  } else {
    seal->window |= (uint32_t)1u << (seal->newest - 1u - counter);
  }
}

static int32_t seal_on_record(
  xrce_seal_t * seal, const uint8_t * record, size_t size, uint8_t * buffer, size_t capacity)
{
  const uint32_t counter = seal_get_32(&record[8]);
  const size_t plain = size - (size_t)XRCE_SEAL_OVERHEAD;

  if (
    !seal->is_ready || seal_get_32(&record[4]) != seal->own || seal_get_32(&record[12]) != 0u ||
    counter > LAST_RECORD || plain > capacity) {
    return seal_refuse(seal);
  }
  if (!seal_is_new(seal, counter)) {
    ++seal->replayed;
    return -1;
  }
  if (!microros_seal_open(seal->receiving, counter, NULL, 0, &record[RECORD_HEAD], plain, buffer)) {
    return seal_refuse(seal);
  }
  seal_note(seal, counter);
  return (int32_t)plain;
}

/* A refusal is not authenticated: it changes nothing but the reason that the application sees. */
static int32_t seal_on_refusal(xrce_seal_t * seal, const uint8_t * refusal)
{
  if (seal_awaits_answer(seal) && seal_get_32(&refusal[4]) == seal->own) {
    seal->fault = (uint8_t)XRCE_SEAL_REFUSED;
  }
  return seal_refuse(seal);
}

int32_t xrce_transport_receive(xrce_transport_t * transport, uint8_t * buffer, size_t capacity)
{
  xrce_seal_t * seal = &transport->seal;
  uint8_t * input = xrce_seal_input(transport);
  const int32_t received = xrce_plain_receive(transport, input, XRCE_SEAL_RECORD);
  const size_t size = received > 0 ? (size_t)received : 0u;

  if (received <= 0) {
    return received;
  }
  if (size > (size_t)XRCE_SEAL_OVERHEAD && seal_has_head(input, TYPE_RECORD)) {
    return seal_on_record(seal, input, size, buffer, capacity);
  }
  if (size > (size_t)XRCE_SEAL_HELLO && seal_has_head(input, TYPE_SECOND)) {
    return seal_on_second(transport, input, size);
  }
  if (size == (size_t)REFUSAL && input[0] == (uint8_t)TYPE_REFUSAL) { /* whatever the agent's version */
    return seal_on_refusal(seal, input);
  }
  return seal_refuse(seal);
}
