/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_datagrams.h"
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
  WINDOW = 32,
  LARGEST = MICROROS_MTU > MICROROS_INPUT_SIZE ? MICROROS_MTU : MICROROS_INPUT_SIZE
};

/* A session ends after this many records in one direction, long before a nonce could repeat. */
#define LAST_RECORD 0xffff0000u

/* One datagram, on its way in or out. */
static uint8_t seal_record[(size_t)RECORD_HEAD + (size_t)LARGEST + (size_t)MICROROS_SEAL_TAG];

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
static bool seal_hello(xrce_datagrams_t * datagrams)
{
  static const uint8_t label[] = {
    'm', 'i', 'c', 'r', 'o', 'r', 'o', 's', '-', 'g', 'e', 'n', ' ', 's', 'e', 'a', 'l'};
  uint8_t psk[MICROROS_SEAL_KEY];
  uint8_t prologue[sizeof(label) + (size_t)XRCE_SEAL_HELLO];
  uint8_t own[4];
  bool done;

  datagrams->fault = (uint8_t)XRCE_SEAL_NO_KEY;
  if (!microros_seal_psk(MICROROS_CLIENT_KEY, psk)) {
    xrce_noise_wipe(psk, sizeof(psk)); /* it may have a part of the key */
    return false;
  }
  datagrams->fault = (uint8_t)XRCE_SEAL_NO_CRYPTO;
  done = microros_seal_random(own, sizeof(own));
  if (done) {
    datagrams->own = seal_get_32(own);
    seal_put_head(datagrams->first, TYPE_FIRST, datagrams->own);
    seal_put_32(&datagrams->first[8], MICROROS_CLIENT_KEY);
    (void)memcpy(prologue, label, sizeof(label));
    (void)memcpy(&prologue[sizeof(label)], datagrams->first, XRCE_SEAL_HELLO);
    done = xrce_noise_begin(
      &datagrams->noise, psk, prologue, sizeof(prologue), &datagrams->first[XRCE_SEAL_HELLO]);
  }
  xrce_noise_wipe(psk, sizeof(psk));
  return done;
}

static void seal_clear(xrce_datagrams_t * datagrams)
{
  datagrams->is_ready = false;
  xrce_noise_clear(&datagrams->noise);
  xrce_noise_wipe(datagrams->sending, sizeof(datagrams->sending));
  xrce_noise_wipe(datagrams->receiving, sizeof(datagrams->receiving));
}

/* Begins a handshake. Without one, `fault` says why. */
static bool seal_begin(xrce_datagrams_t * datagrams)
{
  const uint32_t now = port_time_ms();

  seal_clear(datagrams);
  datagrams->since_ms = now;
  datagrams->due_ms = now;
  if (!seal_hello(datagrams)) {
    seal_clear(datagrams);
    return false;
  }
  datagrams->fault = (uint8_t)XRCE_SEAL_SILENT;
  return true;
}

bool xrce_datagrams_open(xrce_datagrams_t * datagrams, const char * host, uint16_t port)
{
  datagrams->waiting_size = 0;
  if (!port_udp_open(&datagrams->socket, host, port)) {
    datagrams->fault = (uint8_t)XRCE_SEAL_FINE; /* not for a reason of this layer */
    return false;
  }
  if (!seal_begin(datagrams)) {
    port_udp_close(&datagrams->socket);
    return false;
  }
  return true;
}

void xrce_datagrams_close(xrce_datagrams_t * datagrams)
{
  seal_clear(datagrams);
  xrce_noise_wipe(datagrams->waiting, sizeof(datagrams->waiting));
  datagrams->waiting_size = 0;
  port_udp_close(&datagrams->socket);
}

static bool seal_send_record(xrce_datagrams_t * datagrams, const uint8_t * message, size_t size)
{
  const uint32_t counter = datagrams->next;

  if (size > (size_t)LARGEST) {
    return false;
  }
  seal_put_head(seal_record, TYPE_RECORD, datagrams->peer);
  seal_put_32(&seal_record[8], counter);
  seal_put_32(&seal_record[12], 0);
  if (!microros_seal_seal(datagrams->sending, counter, NULL, 0, message, size, &seal_record[RECORD_HEAD])) {
    return false;
  }
  datagrams->next = counter + 1u; /* never used again, even if the port does not send the record */
  return port_udp_send(
    &datagrams->socket, seal_record, (size_t)RECORD_HEAD + size + (size_t)MICROROS_SEAL_TAG);
}

/* Sends the first message of the handshake if it is due, at growing intervals. */
static void seal_repeat(xrce_datagrams_t * datagrams)
{
  const uint32_t now = port_time_ms();

  if (xrce_is_due(now, datagrams->due_ms)) {
    datagrams->due_ms = now + xrce_seal_pause(now - datagrams->since_ms);
    (void)port_udp_send(
      &datagrams->socket, datagrams->first, sizeof(datagrams->first)); /* repeated if lost */
  }
}

static bool seal_keep(xrce_datagrams_t * datagrams, const uint8_t * message, size_t size)
{
  if (size > sizeof(datagrams->waiting)) {
    return false;
  }
  (void)memcpy(datagrams->waiting, message, size);
  datagrams->waiting_size = (uint8_t)size;
  return true;
}

/* Returns whether the agent has answered nothing since the handshake: it may have restarted, and forgotten the session. */
static bool seal_is_unanswered(const xrce_datagrams_t * datagrams)
{
  return datagrams->newest == 0u && xrce_is_due(port_time_ms(), datagrams->due_ms);
}

bool xrce_datagrams_send(xrce_datagrams_t * datagrams, const uint8_t * message, size_t size)
{
  if (datagrams->is_ready && seal_is_unanswered(datagrams)) {
    datagrams->is_ready = false;
    datagrams->fault = (uint8_t)XRCE_SEAL_FINE; /* begins below */
  }
  if (datagrams->is_ready && datagrams->next < LAST_RECORD && datagrams->newest < LAST_RECORD) {
    return seal_send_record(datagrams, message, size);
  }
  if ((datagrams->is_ready || datagrams->fault <= (uint8_t)XRCE_SEAL_NO_CRYPTO) && !seal_begin(datagrams)) {
    return false;
  }
  seal_repeat(datagrams);
  return seal_keep(datagrams, message, size);
}

static int32_t seal_refuse(xrce_datagrams_t * datagrams)
{
  ++datagrams->refused;
  return -1;
}

/* The second message of the handshake: the session begins. */
static int32_t seal_on_second(xrce_datagrams_t * datagrams, size_t size)
{
  if (size != (size_t)XRCE_SEAL_FIRST || seal_get_32(&seal_record[8]) != datagrams->own) {
    return seal_refuse(datagrams);
  }
  if (datagrams->is_ready) {
    return 0; /* the answer to a repetition */
  }
  if (!xrce_noise_finish(
        &datagrams->noise, &seal_record[XRCE_SEAL_HELLO], datagrams->sending, datagrams->receiving)) {
    datagrams->fault = (uint8_t)XRCE_SEAL_FORGED;
    return seal_refuse(datagrams);
  }
  xrce_noise_clear(&datagrams->noise);
  datagrams->peer = seal_get_32(&seal_record[4]);
  datagrams->next = 0;
  datagrams->newest = 0;
  datagrams->window = 0;
  datagrams->is_ready = true;
  datagrams->due_ms = port_time_ms() + 2u * (uint32_t)MICROROS_RETRY_MOST_MS;
  datagrams->fault = (uint8_t)XRCE_SEAL_FINE;
  if (datagrams->waiting_size > 0u) {
    const size_t waiting = datagrams->waiting_size;

    datagrams->waiting_size = 0;
    (void)seal_send_record(datagrams, datagrams->waiting, waiting); /* whoever sent it repeats it */
  }
  return 0;
}

/* Returns whether a record with this counter may be new. RFC 4303, 3.4.3. */
static bool seal_is_new(const xrce_datagrams_t * datagrams, uint32_t counter)
{
  const uint32_t age = datagrams->newest - 1u - counter;

  if (counter >= datagrams->newest) {
    return true;
  }
  return age < (uint32_t)WINDOW && ((datagrams->window >> age) & 1u) == 0u;
}

static void seal_note(xrce_datagrams_t * datagrams, uint32_t counter)
{
  if (counter >= datagrams->newest) {
    const uint32_t ahead = counter - datagrams->newest + 1u;

    datagrams->window = ahead < (uint32_t)WINDOW ? datagrams->window << ahead : 0u;
    datagrams->window |= 1u;
    datagrams->newest = counter + 1u;
  } else {
    datagrams->window |= (uint32_t)1u << (datagrams->newest - 1u - counter);
  }
}

static int32_t seal_on_record(xrce_datagrams_t * datagrams, size_t size, uint8_t * buffer, size_t capacity)
{
  const uint32_t counter = seal_get_32(&seal_record[8]);
  const size_t plain = size - (size_t)RECORD_HEAD - (size_t)MICROROS_SEAL_TAG;

  if (
    !datagrams->is_ready || seal_get_32(&seal_record[4]) != datagrams->own ||
    seal_get_32(&seal_record[12]) != 0u || counter > LAST_RECORD || plain > capacity) {
    return seal_refuse(datagrams);
  }
  if (!seal_is_new(datagrams, counter)) {
    ++datagrams->replayed;
    return -1;
  }
  if (!microros_seal_open(datagrams->receiving, counter, NULL, 0, &seal_record[RECORD_HEAD], plain, buffer)) {
    return seal_refuse(datagrams);
  }
  seal_note(datagrams, counter);
  return (int32_t)plain;
}

/* A refusal is not authenticated: it changes nothing but the reason that the application sees. */
static int32_t seal_on_refusal(xrce_datagrams_t * datagrams)
{
  if (!datagrams->is_ready && seal_get_32(&seal_record[4]) == datagrams->own) {
    datagrams->fault = (uint8_t)XRCE_SEAL_REFUSED;
  }
  return seal_refuse(datagrams);
}

int32_t xrce_datagrams_receive(xrce_datagrams_t * datagrams, uint8_t * buffer, size_t capacity)
{
  const int32_t received = port_udp_receive(&datagrams->socket, seal_record, sizeof(seal_record));
  const size_t size = received > 0 ? (size_t)received : 0u;

  if (received == 0) {
    return 0;
  }
  if (size > (size_t)RECORD_HEAD + (size_t)MICROROS_SEAL_TAG && seal_has_head(seal_record, TYPE_RECORD)) {
    return seal_on_record(datagrams, size, buffer, capacity);
  }
  if (size > (size_t)XRCE_SEAL_HELLO && seal_has_head(seal_record, TYPE_SECOND)) {
    return seal_on_second(datagrams, size);
  }
  if (size == (size_t)REFUSAL && seal_record[0] == (uint8_t)TYPE_REFUSAL) { /* whatever the agent's version */
    return seal_on_refusal(datagrams);
  }
  return seal_refuse(datagrams);
}
