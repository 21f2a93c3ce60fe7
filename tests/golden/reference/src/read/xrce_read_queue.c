/* SPDX-License-Identifier: Apache-2.0 */
/* The queues: rings of slots of one size each. */
#include "microros/xrce_client.h"
#include "microros/xrce_input.h"
#include "microros/xrce_loan.h"
#include "microros/xrce_queue_memory.h"
#include "microros/xrce_read.h"
#include "microros/xrce_turn_bytes.h"

#include <string.h>

xrce_slot_t xrce_queue_slots[MICROROS_QUEUE_SLOTS];
uint32_t xrce_queue_words[XRCE_QUEUE_WORDS];

static xrce_receiver_t * queue_of(const xrce_endpoint_t * endpoint)
{
  return &endpoint->client->receivers[endpoint->index - MICROROS_PUBLISHERS_MAX];
}

/* Returns the ring's slot of the i-th sample. */
static uint8_t queue_slot(const xrce_receiver_t * receiver, const xrce_queue_t * queue, uint8_t i)
{
  const uint32_t slot = (uint32_t)receiver->head + i;

  return (uint8_t)(slot < queue->slots ? slot : slot - queue->slots);
}

static void queue_drop_oldest(xrce_receiver_t * receiver, const xrce_queue_t * queue)
{
  receiver->head = queue_slot(receiver, queue, 1);
  --receiver->count;
}

/* Frees a slot of a full queue: that of the oldest sample or, while that is in use, of the newest other one. */
static bool queue_make_room(
  const xrce_client_t * client, xrce_receiver_t * receiver, const xrce_queue_t * queue)
{
  if (!xrce_loan_is_out(client, receiver)) {
    queue_drop_oldest(receiver, queue);
    return true;
  }
  if (receiver->count == 1u) {
    return false;
  }
  --receiver->count;
  return true;
}

static uint8_t * queue_bytes(const xrce_queue_t * queue, uint8_t slot)
{
  return xrce_queue_at(queue->offset + (uint32_t)slot * queue->slot_size);
}

uint8_t * xrce_read_free_slot(xrce_client_t * client, const xrce_receiver_t * receiver)
{
  const xrce_queue_t * queue = xrce_read_queue(client, receiver);

  return queue_bytes(queue, queue_slot(receiver, queue, receiver->count));
}

void xrce_read_fill(xrce_client_t * client, xrce_receiver_t * receiver, const xrce_sample_t * sample)
{
  const xrce_queue_t * queue = xrce_read_queue(client, receiver);
  xrce_slot_t * slot = &xrce_queue_slots[queue->first + queue_slot(receiver, queue, receiver->count)];

  slot->arrived_ms = sample->arrived_ms;
  slot->size = sample->size;
  slot->big_endian = sample->big_endian;
  ++receiver->count;
}

void xrce_read_keep(
  xrce_client_t * client, xrce_receiver_t * receiver, const xrce_sample_t * sample, bool reliable)
{
  const xrce_queue_t * queue = xrce_read_queue(client, receiver);

  if (receiver->count == queue->slots) {
    xrce_read_drop(client, receiver);
    if (reliable || !queue_make_room(client, receiver, queue)) {
      return;
    }
  }
  /* at most MICROROS_QUEUES_SIZE bytes */
  (void)memcpy(xrce_read_free_slot(client, receiver), sample->data, sample->size);
  xrce_read_fill(client, receiver, sample);
}

bool xrce_read_peek(const xrce_endpoint_t * endpoint, xrce_sample_t * sample)
{
  xrce_client_t * client = endpoint->client;
  const xrce_receiver_t * receiver = queue_of(endpoint);
  const xrce_queue_t * queue = xrce_read_queue(client, receiver);
  const xrce_slot_t * slot = &xrce_queue_slots[queue->first + receiver->head];

  if (receiver->count == 0u || xrce_loan_is_out(client, receiver)) {
    return false;
  }
  sample->data = queue_bytes(queue, receiver->head);
  sample->arrived_ms = slot->arrived_ms;
  sample->size = slot->size;
  sample->big_endian = slot->big_endian;
  return true;
}

void xrce_read_pop(const xrce_endpoint_t * endpoint, bool refused)
{
  xrce_receiver_t * receiver = queue_of(endpoint);

  if (refused) {
    ++receiver->refused;
    ++endpoint->client->session.statistics.dropped;
  }
  queue_drop_oldest(receiver, xrce_read_queue(endpoint->client, receiver));
  xrce_turn_change(endpoint->client);
}
