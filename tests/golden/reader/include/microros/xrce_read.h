/* SPDX-License-Identifier: Apache-2.0 */
/*
 * READ_DATA and DATA: what the agent sends waits in a queue of its endpoint until it is taken. The endpoints that receive
 * are data readers, repliers and requesters; a sample is what stands behind the object's id, kept as it came.
 *
 * READ_DATA is sent when an endpoint is complete at the agent, and again in each new session. It is flow control:
 * - A best-effort endpoint asks once, for everything. Its queue gives the oldest sample up for a newer one.
 * - A reliable one asks for as many samples as its queue has room for, and again when these have arrived and half of the
 *   queue is free. So the agent never sends what has no room here; what waits, waits in DDS. A sample that comes in
 *   fragments is put together in its slot, which belongs to the stream until the last of them is here, to the application
 *   from then on until it has taken the sample, and to nobody else: it is asked for again only after that.
 *
 * READ_DATA has no answer when it succeeds. It goes on a reliable stream of its own (0x81), one at a time, and is sent
 * again until it is acknowledged; so it needs no history, and nothing that is written stands in its way.
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

/* Flags of DATA: every format but that of one sample without a header. */
enum { XRCE_READ_FORMATS = 0x0e };

/* Where a queue lies among the slots of all; from the plan. */
typedef struct xrce_queue_t {
  uint32_t offset;    /* of its first byte */
  uint16_t slot_size; /* the largest sample, bytes */
  uint16_t first;     /* its first slot */
  uint8_t slots;
} xrce_queue_t;

/* In the order of the receivers: the endpoints from XRCE_READERS_AT on. */
extern const xrce_queue_t xrce_queues[XRCE_RECEIVERS];

typedef struct xrce_slot_t {
  uint32_t arrived_ms;
  uint16_t size;
  bool big_endian;
} xrce_slot_t;

/* One endpoint that receives. All zero: nothing was asked for and nothing has come. */
typedef struct xrce_receiver_t {
  uint32_t dropped; /* samples that had no room: see xrce_read_counters_t */
  uint32_t refused;
  uint32_t due_ms;  /* while `resting`: when to ask again */
  uint16_t request; /* of the READ_DATA in force, or XRCE_REQUEST_NONE */
  uint16_t before;  /* of the one before it, of which samples may still be on their way */
  uint16_t granted; /* samples of a reliable endpoint that were asked for and have not come */
  uint16_t large;   /* bytes of the last sample that was larger than a slot, until this was told; 0: none */
  uint8_t status;   /* with which the agent refused READ_DATA, until this was told; 0: none */
  uint8_t head;     /* the oldest sample's slot */
  uint8_t count;
  bool resting : 1;  /* the agent refused READ_DATA a moment ago */
  bool arriving : 1; /* fragments are being put together in the slot behind the last sample */
} xrce_receiver_t;

/* The READ_DATA that is not acknowledged yet. */
typedef struct xrce_reading_t {
  uint32_t due_ms;   /* when to send it again */
  uint32_t asked_ms; /* when it was sent first */
  uint16_t sequence; /* its number, or the next one's */
  uint16_t request;
  uint16_t samples;
  uint16_t receiver; /* whose it is; while there is none, where to look next */
  bool outstanding;
} xrce_reading_t;

/* The oldest sample; `data` is the library's, and stays until xrce_read_pop or until the session is pumped. */
typedef struct xrce_sample_t {
  const uint8_t * data;
  uint32_t arrived_ms; /* port_time_ms() */
  uint16_t size;
  bool big_endian;
} xrce_sample_t;

/* A sample that comes in fragments: of which READ_DATA, from which object, and how many bytes behind the object's id. */
typedef struct xrce_arrival_t {
  uint16_t request;
  uint16_t object;
  uint16_t size;
  uint8_t flags; /* of DATA */
} xrce_arrival_t;

/* Samples since the endpoint was opened. `dropped`: there was no room; of a best-effort endpoint the oldest, of a reliable
 * one what the agent sent beyond what it was asked for. `refused`: larger than a slot, or not decoded. */
typedef struct xrce_read_counters_t {
  uint32_t dropped;
  uint32_t refused;
} xrce_read_counters_t;

/* --- for the layer above; `endpoint` is one that receives --- */

/* The endpoint has a new owner, and its place is not open yet: the queue is emptied, the counters start at 0. */
void xrce_read_open(const xrce_endpoint_t * endpoint);

/* Gives the oldest sample; false: there is none. */
bool xrce_read_peek(const xrce_endpoint_t * endpoint, xrce_sample_t * sample);

/* The oldest sample was taken; there is one. `refused` counts it as such: it is no message of its type. */
void xrce_read_pop(const xrce_endpoint_t * endpoint, bool refused);

/* Returns whether there is a sample, or something to tell about samples that cannot be had. */
bool xrce_read_is_ready(const xrce_endpoint_t * endpoint);

/* Gives, once, the size of a sample that was larger than a slot (*fits), and else 0. */
uint16_t xrce_read_large(const xrce_endpoint_t * endpoint, uint16_t * fits);

/* Gives, once, the status with which the agent refused READ_DATA, and else 0. It is asked again by itself. */
uint8_t xrce_read_status(const xrce_endpoint_t * endpoint);

xrce_read_counters_t xrce_read_counters(const xrce_endpoint_t * endpoint);

/* --- what xrce_routes.c and the input streams call --- */

void xrce_read_renew(xrce_client_t * client);
void xrce_read_step(xrce_client_t * client, uint32_t now);
void xrce_read_on_data(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);
void xrce_read_on_status(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

void xrce_read_on_acknack(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now);

/* A sample that comes in fragments is larger than what can be kept of it: its reader is told. */
void xrce_read_refuse(xrce_client_t * client, uint16_t request, uint16_t object, uint16_t size);

/* Fragments of a sample begin. False: it cannot be kept; its reader is told, or it is counted. */
bool xrce_read_begin(xrce_client_t * client, const xrce_arrival_t * arrival);

/* Returns the place of its `size` bytes; NULL: it was given up, since the reader was closed or the agent has sent it
 * another sample meanwhile. */
uint8_t * xrce_read_place(xrce_client_t * client, const xrce_arrival_t * arrival);

/* All its bytes are there. */
void xrce_read_finish(xrce_client_t * client, const xrce_arrival_t * arrival, uint32_t now);

/*
 * With MICROROS_INPUT_READER, whose slot is the end of the input buffer: a best-effort sample that waits alone. Messages
 * are received in front of it. One that does not fit there takes its place, as a newer sample does, and it is counted as
 * dropped. The first function is told what every call of the transport's receive has returned, before anything else is
 * done; the second one is called when all submessages of a message are handled, and moves the sample to its slot.
 */
void xrce_read_on_input(xrce_client_t * client, int32_t received);
void xrce_read_settle(xrce_client_t * client);

/* --- for this component alone --- */

/* Returns the receiver of an object, or NULL: none that is open. */
xrce_receiver_t * xrce_read_find(xrce_client_t * client, uint16_t object);

/* Returns the receiver of a sample of this object that this READ_DATA asked for, or NULL: one of a former owner. */
xrce_receiver_t * xrce_read_asked(xrce_client_t * client, uint16_t request, uint16_t object);

/* One of the samples that were asked for is here. */
void xrce_read_count(xrce_client_t * client, xrce_receiver_t * receiver, uint16_t request);

/* Returns the geometry of a receiver's queue. */
const xrce_queue_t * xrce_read_queue(const xrce_client_t * client, const xrce_receiver_t * receiver);

/* Returns the bytes of the largest sample. */
static inline uint16_t xrce_read_largest(const xrce_client_t * client, const xrce_receiver_t * receiver)
{
  return xrce_read_queue(client, receiver)->slot_size;
}

/* Returns how many samples of the largest size have room, once half of those that an empty queue holds have; else 0. */
static inline uint16_t xrce_read_room(const xrce_client_t * client, const xrce_receiver_t * receiver)
{
  const xrce_queue_t * queue = xrce_read_queue(client, receiver);
  const uint16_t free = (uint16_t)(queue->slots - receiver->count);

  return 2u * free >= queue->slots ? free : 0u;
}

/* Keeps a sample that is no larger than the largest, or counts it as dropped. */
void xrce_read_keep(
  xrce_client_t * client, xrce_receiver_t * receiver, const xrce_sample_t * sample, bool reliable);

/* Counts a sample that has no room. */
void xrce_read_drop(xrce_client_t * client, xrce_receiver_t * receiver);

/* Returns whether there is a free slot for fragments. */
bool xrce_read_has_room(const xrce_client_t * client, const xrce_receiver_t * receiver);

/* Returns the bytes of the free slot behind the last sample; there is one. */
uint8_t * xrce_read_free_slot(xrce_client_t * client, const xrce_receiver_t * receiver);

/* What the free slot has is a sample now, which waits; its `data` does not matter. */
void xrce_read_fill(xrce_client_t * client, xrce_receiver_t * receiver, const xrce_sample_t * sample);

/* Whether the samples come on the reliable stream. */
bool xrce_read_is_reliable(const xrce_client_t * client, const xrce_receiver_t * receiver);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_READ_H */
