/* SPDX-License-Identifier: Apache-2.0 */
/* Requests and replies between images: a service has a ring of each for each image with a client. */
#include "microros/rmw_shared_call.h"

#include "microros/error.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_shared_fan.h"
#include "microros/rmw_shared_ring.h"
#include "microros/xrce_client.h"

#include <stddef.h>

/* Words of a call in its slot, between size and body: the number of the request and the run of its client, then the two halves of
 * the sequence number. A reply has those of its request. */
enum { CALL_NUMBER = 1, CALL_LOW = 2, CALL_HIGH = 3, CALL_WORDS = 3 };

enum { CALL_FIRST_SERVICE = XRCE_REPLIERS_AT - MICROROS_NODES_MAX };

enum { CALL_FIRST_CLIENT = XRCE_REQUESTERS_AT - MICROROS_NODES_MAX };

/* Returns the ring of a client's requests, or the first one of a server's. That of the replies is the next one. */
static const rmw_shared_ring_t * call_requests(uint16_t endpoint)
{
  return &rmw_shared_rings[rmw_shared_ring_of[endpoint]];
}

uint32_t rmw_shared_call_words(const rmw_shared_ring_t * ring)
{
  return ring->endpoint >= (uint16_t)CALL_FIRST_SERVICE ? (uint32_t)CALL_WORDS : 0u;
}

/* Returns the part of a client's run that its requests carry: a client that was opened again gets no replies to earlier ones. */
static uint16_t call_run(const rmw_shared_ring_t * requests)
{
  return (uint16_t)(rmw_shared_writer(requests).run & UINT16_MAX);
}

bool rmw_shared_call_is_wanted(const rmw_shared_ring_t * ring, const uint32_t * slot)
{
  return ring->endpoint < (uint16_t)CALL_FIRST_CLIENT ||
         slot[CALL_NUMBER] >> 16 == (uint32_t)call_run(&ring[-1]);
}

void rmw_shared_call_note(
  const rmw_shared_ring_t * ring, const uint32_t * slot, const rmw_local_queue_t * queue, uint8_t place)
{
  if (ring->endpoint >= (uint16_t)CALL_FIRST_SERVICE) {
    const uint64_t sequence = (uint64_t)slot[CALL_HIGH] << 32 | slot[CALL_LOW];

    queue->origins[place].number = (uint16_t)(slot[CALL_NUMBER] & UINT16_MAX);
    queue->origins[place].client = (uint16_t)(slot[CALL_NUMBER] >> 16);
    queue->origins[place].sequence = (int64_t)sequence;
  }
}

void rmw_shared_call_opened(const xrce_endpoint_t * endpoint)
{
  if (
    endpoint->index >= (uint16_t)CALL_FIRST_CLIENT && rmw_shared_has_ring(endpoint) &&
    rmw_shared_look() == RMW_SHARED_ROOM) {
    rmw_shared_renew(call_requests(endpoint->index)); /* nobody waits for replies to what is in the ring */
  }
}

bool rmw_shared_call_is_open(const xrce_endpoint_t * client)
{
  uint32_t count; /* only asked whether there is a reader */
  const rmw_shared_room_t room = rmw_shared_reserve(call_requests(client->index), &count);

  return room == RMW_SHARED_ROOM || room == RMW_SHARED_FULL;
}

/* The ring of a message, and who sends it. */
typedef struct call_way_t {
  const rmw_shared_ring_t * ring;
  const xrce_endpoint_t * from;
} call_way_t;

/* Writes a message with its identity to a ring. Without a reader in the other image it is dropped and counted. */
static rmw_ret_t call_write(
  const call_way_t * way, const microros_message_type_t * sent, const rmw_local_origin_t * origin,
  const void * message)
{
  const uint64_t sequence = (uint64_t)origin->sequence;
  cdr_fault_t fault; /* set if the message is refused */
  uint32_t count;
  uint32_t size;
  uint32_t * slot;
  const rmw_shared_room_t room = rmw_shared_reserve(way->ring, &count);

  if (room == RMW_SHARED_ABSENT) {
    ++way->from->client->session.statistics.dropped;
  }
  if (room != RMW_SHARED_ROOM) {
    return rmw_shared_error(room, way->from->name);
  }
  slot = rmw_shared_slot(way->ring, count);
  size = sent->encode(message, (uint8_t *)&slot[1 + (int)CALL_WORDS], &fault);
  if (size == 0u) {
    return rmw_encode_refuse(sent, &fault);
  }
  slot[CALL_NUMBER] = (uint32_t)origin->client << 16 | origin->number;
  slot[CALL_LOW] = (uint32_t)(sequence & UINT32_MAX);
  slot[CALL_HIGH] = (uint32_t)(sequence >> 32);
  rmw_shared_commit(way->ring, count, size);
  return RMW_RET_OK;
}

rmw_ret_t rmw_shared_call_request(
  const xrce_endpoint_t * client, const microros_message_type_t * sent, const rmw_local_number_t * number,
  const void * message)
{
  const call_way_t way = {call_requests(client->index), client};
  const rmw_local_origin_t origin = {
    .client = rmw_shared_look() == RMW_SHARED_ROOM ? call_run(call_requests(client->index)) : 0u,
    .number = number->request,
    .sequence = number->sequence};

  return call_write(&way, sent, &origin, message);
}

rmw_ret_t rmw_shared_call_reply(
  const xrce_endpoint_t * service, const microros_message_type_t * sent, const rmw_local_origin_t * origin,
  const void * message)
{
  const call_way_t way = {rmw_shared_replies(call_requests(service->index), origin->client), service};

  if (way.ring == NULL) {
    ++service->client->session.statistics.dropped; /* the client waits for other replies, or for none */
    return RMW_RET_OK;
  }
  return call_write(&way, sent, origin, message);
}
