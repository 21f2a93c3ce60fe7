/* SPDX-License-Identifier: Apache-2.0 */
/* Fragmented samples, each assembled in the slot in which it waits afterwards. */
#include "microros/xrce_client.h"
#include "microros/xrce_read.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

bool xrce_read_begin(xrce_client_t * client, const xrce_arrival_t * arrival)
{
  xrce_receiver_t * receiver = xrce_read_requested(client, arrival->request, arrival->object);

  if (receiver == NULL) {
    return false;
  }
  if (arrival->size > xrce_read_largest(client, receiver)) {
    xrce_read_refuse(client, arrival->request, arrival->object, arrival->size);
    return false;
  }
  receiver->arriving = xrce_read_has_room(client, receiver);
  if (!receiver->arriving) {
    xrce_read_count(client, receiver, arrival->request);
    xrce_read_drop(client, receiver); /* the agent has sent more than was requested */
  }
  return receiver->arriving;
}

/* Returns the receiver in whose free slot a sample is being assembled; NULL if it was dropped. */
static xrce_receiver_t * read_arriving(xrce_client_t * client, const xrce_arrival_t * arrival)
{
  xrce_receiver_t * receiver = xrce_read_requested(client, arrival->request, arrival->object);

  return receiver != NULL && receiver->arriving ? receiver : NULL;
}

uint8_t * xrce_read_place(xrce_client_t * client, const xrce_arrival_t * arrival)
{
  const xrce_receiver_t * receiver = read_arriving(client, arrival);

  return receiver != NULL ? xrce_read_free_slot(client, receiver) : NULL;
}

void xrce_read_finish(xrce_client_t * client, const xrce_arrival_t * arrival, uint32_t now)
{
  xrce_receiver_t * receiver = read_arriving(client, arrival);
  const xrce_sample_t sample = {NULL, now, arrival->size, (arrival->flags & XRCE_FLAG_LITTLE_ENDIAN) == 0u};

  if (receiver != NULL) {
    xrce_read_count(client, receiver, arrival->request);
    receiver->arriving = false;
    xrce_read_fill(client, receiver, &sample);
  }
}
