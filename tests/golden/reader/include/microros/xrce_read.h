/* SPDX-License-Identifier: Apache-2.0 */
/*
 * READ_DATA and DATA: samples from the agent wait in the queue of their endpoint until they are taken.
 * Receiving endpoints are data readers, repliers and requesters; a sample consists of the bytes after the
 * object id, stored unchanged.
 *
 * READ_DATA is sent when an endpoint is complete at the agent, and again in each new session. It controls
 * the flow:
 * - A best-effort endpoint asks once, without a limit. Its queue drops the oldest sample for a newer one.
 * - A reliable one asks for as many samples as its queue has room for, and again when these have arrived
 *   and half of the queue is free. So the agent never sends a sample without room here; others wait in
 *   DDS. A fragmented sample is assembled in its slot, which belongs to the stream until the last fragment
 *   arrives, then to the application until it has taken the sample; it is only requested again after that.
 *
 * A successful READ_DATA has no answer. It uses a separate reliable stream (0x81), one at a time, and is
 * repeated until it is acknowledged; so it needs no history and never waits for published messages.
 */
#ifndef MICROROS_XRCE_READ_H
#define MICROROS_XRCE_READ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_objects.h"
#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Flags of DATA: every format except a single sample without a header. */
enum { XRCE_READ_FORMATS = 0x0e };

/* Position of a queue in the storage of all queues; from the plan. */
typedef struct xrce_queue_t {
  uint32_t offset;    /* of its first byte */
  uint16_t slot_size; /* largest sample in bytes */
  uint16_t first;     /* its first slot */
  uint8_t slots;
} xrce_queue_t;

/* In the order of the receivers: endpoints from XRCE_READERS_AT on. */
extern const xrce_queue_t xrce_queues[XRCE_RECEIVERS];

typedef struct xrce_slot_t {
  uint32_t arrived_ms;
  uint16_t size;
  bool big_endian;
} xrce_slot_t;

/* A receiving endpoint. Zero-initialized: nothing requested, nothing received. */
typedef struct xrce_receiver_t {
  uint32_t dropped; /* samples without room: see xrce_read_counters_t */
  uint32_t refused;
  uint32_t due_ms;  /* while `resting`: when to request again */
  uint16_t request; /* of the current READ_DATA, or XRCE_REQUEST_NONE */
  uint16_t before;  /* of the previous one, whose samples may still arrive */
  uint16_t granted; /* requested samples of a reliable endpoint that have not arrived */
  uint16_t large;   /* size of the last sample larger than a slot, until reported; 0: none */
  uint8_t status;   /* status of a refused READ_DATA, until reported; 0: none */
  uint8_t head;     /* the oldest sample's slot */
  uint8_t count;
  bool resting : 1;  /* the agent has just refused READ_DATA */
  bool arriving : 1; /* fragments are being assembled in the slot after the last sample */
} xrce_receiver_t;

/* The READ_DATA that is not yet acknowledged. */
typedef struct xrce_reading_t {
  uint32_t due_ms;   /* when to repeat it */
  uint32_t requested_ms; /* when it was first sent */
  uint16_t sequence; /* its number, or the next one's */
  uint16_t request;
  uint16_t samples;
  uint16_t receiver; /* its receiver; if there is no READ_DATA, where to look next */
  bool outstanding;
} xrce_reading_t;

/*
 * The oldest sample; `data` belongs to the library and is valid until xrce_read_pop or until the session
 * is pumped. */
typedef struct xrce_sample_t {
  const uint8_t * data;
  uint32_t arrived_ms; /* port_time_ms() */
  uint16_t size;
  bool big_endian;
} xrce_sample_t;

/* A sample arriving in fragments: its READ_DATA, its object, and its size after the object id. */
typedef struct xrce_arrival_t {
  uint16_t request;
  uint16_t object;
  uint16_t size;
  uint8_t flags; /* of DATA */
} xrce_arrival_t;

/* Samples since the endpoint was opened. `dropped`: no room; the oldest of a best-effort endpoint, of a
 * reliable one those that the agent sent without a request. `refused`: larger than a slot, or not
 * decodable. */
typedef struct xrce_read_counters_t {
  uint32_t dropped;
  uint32_t refused;
} xrce_read_counters_t;

/* --- for the layer above; `endpoint` is a receiving one --- */

/* Called for a new owner, before the place is open: clears queue and counters. */
void xrce_read_open(const xrce_endpoint_t * endpoint);

/* Returns the oldest sample in *sample; false if the queue is empty. */
bool xrce_read_peek(const xrce_endpoint_t * endpoint, xrce_sample_t * sample);

/* Removes the oldest sample, which exists. `refused`: it is counted as invalid for its type. */
void xrce_read_pop(const xrce_endpoint_t * endpoint, bool refused);

/* Returns whether a sample, or an unreported loss of samples, is available. */
bool xrce_read_is_ready(const xrce_endpoint_t * endpoint);

/* Returns once the size of a sample larger than a slot (*fits), otherwise 0. */
uint16_t xrce_read_large(const xrce_endpoint_t * endpoint, uint16_t * fits);

/* Returns once the status of a refused READ_DATA, otherwise 0. The request is repeated automatically. */
uint8_t xrce_read_status(const xrce_endpoint_t * endpoint);

xrce_read_counters_t xrce_read_counters(const xrce_endpoint_t * endpoint);

/* --- called by xrce_routes.c and the input streams --- */

void xrce_read_renew(xrce_client_t * client);
void xrce_read_step(xrce_client_t * client, uint32_t now);
void xrce_read_on_data(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);
void xrce_read_on_status(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

void xrce_read_on_acknack(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* Called when a fragmented sample exceeds the available storage: reports it to its reader. */
void xrce_read_refuse(xrce_client_t * client, uint16_t request, uint16_t object, uint16_t size);

/*
 * Called for the first fragment of a sample. Returns false if it cannot be stored; then it is reported to
 * its reader or counted. */
bool xrce_read_begin(xrce_client_t * client, const xrce_arrival_t * arrival);

/* Returns the address of its `size` bytes; NULL if it was dropped, because the reader was closed or the
 * agent has sent another sample meanwhile. */
uint8_t * xrce_read_place(xrce_client_t * client, const xrce_arrival_t * arrival);

/* Called when all its bytes have arrived. */
void xrce_read_finish(xrce_client_t * client, const xrce_arrival_t * arrival, uint32_t now);

/*
 * For MICROROS_INPUT_READER, whose slot is the end of the input buffer: a best-effort sample that waits
 * alone. Messages are received before it. A larger message overwrites it, as a newer sample would, and it
 * is counted as dropped. The first function gets the result of every receive call of the transport, before
 * anything else happens; the second is called when all submessages of a message are handled, and moves the
 * sample to its slot.
 */
void xrce_read_on_input(xrce_client_t * client, int32_t received);
void xrce_read_settle(xrce_client_t * client);

/* --- for this component only --- */

/* Returns the open receiver of an object, or NULL. */
xrce_receiver_t * xrce_read_find(xrce_client_t * client, uint16_t object);

/*
 * Returns the receiver whose current READ_DATA requested a sample of this object; NULL for one of a former
 * owner. */
xrce_receiver_t * xrce_read_requested(xrce_client_t * client, uint16_t request, uint16_t object);

/* Counts the arrival of a requested sample. */
void xrce_read_count(xrce_client_t * client, xrce_receiver_t * receiver, uint16_t request);

/* Returns the geometry of a receiver's queue. */
const xrce_queue_t * xrce_read_queue(const xrce_client_t * client, const xrce_receiver_t * receiver);

/* Returns the size of the largest sample. */
static inline uint16_t xrce_read_largest(const xrce_client_t * client, const xrce_receiver_t * receiver)
{
  return xrce_read_queue(client, receiver)->slot_size;
}

/*
 * Returns how many samples of the largest size fit, if that is at least half of the capacity of an empty
 * queue; otherwise 0. */
static inline uint16_t xrce_read_room(const xrce_client_t * client, const xrce_receiver_t * receiver)
{
  const xrce_queue_t * queue = xrce_read_queue(client, receiver);
  const uint16_t free = (uint16_t)(queue->slots - receiver->count);

  return 2u * free >= queue->slots ? free : 0u;
}

static inline void xrce_receiver_clear_bytes(xrce_receiver_t * receiver)
{
  (void)receiver;
}

/* Makes it zero: member by member, which takes a few stores instead of a call of memset. */
static inline void xrce_receiver_clear(xrce_receiver_t * receiver)
{
  receiver->dropped = 0;
  receiver->refused = 0;
  receiver->due_ms = 0;
  xrce_receiver_clear_bytes(receiver);
  receiver->request = 0;
  receiver->before = 0;
  receiver->granted = 0;
  receiver->large = 0;
  receiver->status = 0;
  receiver->head = 0;
  receiver->count = 0;
  receiver->resting = false;
  receiver->arriving = false;
}

/* Stores a sample that is not larger than the largest, or counts it as dropped. */
void xrce_read_keep(
  xrce_client_t * client, xrce_receiver_t * receiver, const xrce_sample_t * sample, bool reliable);

/* Counts a sample without room. */
void xrce_read_drop(xrce_client_t * client, xrce_receiver_t * receiver);

/* Returns whether there is a free slot for fragments. */
bool xrce_read_has_room(const xrce_client_t * client, const xrce_receiver_t * receiver);

/* Returns the free slot after the last sample; one exists. */
uint8_t * xrce_read_free_slot(xrce_client_t * client, const xrce_receiver_t * receiver);

/* Turns the free slot into a waiting sample; `data` of `sample` is ignored. */
void xrce_read_fill(xrce_client_t * client, xrce_receiver_t * receiver, const xrce_sample_t * sample);

/* Returns whether the samples arrive on the reliable stream. */
bool xrce_read_is_reliable(const xrce_client_t * client, const xrce_receiver_t * receiver);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_READ_H */
