/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages wait here until the task that has the line sends them. Sequence numbers are those of sending: what is dropped
 * takes none, and a message of the session itself may overtake those that wait.
 */
#include "microros/xrce_stream_best_effort.h"

#include "microros/xrce_stream_best_effort_queue.h"
#include "microros/xrce_stream_best_effort_spare.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"

/* The stream of the only client; the lock of the library guards it. */
static struct {
  uint16_t sequence; /* of the next message that is sent */
  uint8_t head;      /* place of the oldest message */
  uint8_t count;     /* at most MICROROS_BEST_EFFORT_SLOTS */
  bool yields;       /* the next turn is for the other streams */
  uint16_t size[MICROROS_BEST_EFFORT_PLACES];
  uint8_t message[MICROROS_BEST_EFFORT_PLACES][MICROROS_BEST_EFFORT_SIZE];
} best_effort;

/* Returns the place after `count` messages. */
static uint32_t queue_place(uint32_t count)
{
  const uint32_t place = best_effort.head + count;

  return place < MICROROS_BEST_EFFORT_PLACES ? place : place - MICROROS_BEST_EFFORT_PLACES;
}

static void queue_remove(void)
{
  best_effort.head = (uint8_t)queue_place(1);
  --best_effort.count;
}

static bool queue_send(xrce_session_t * session, uint8_t * message, size_t size)
{
  bool is_sent;

  xrce_put_header(message, XRCE_SESSION_ID, XRCE_STREAM_BEST_EFFORT, best_effort.sequence);
  is_sent = xrce_session_send(session, message, size);
  if (is_sent) {
    ++best_effort.sequence;
  }
  return is_sent;
}

/* Returns whether the oldest message was sent. */
static bool queue_send_oldest(xrce_session_t * session)
{
  const uint8_t place = best_effort.head;
  const bool is_sent = queue_send(session, best_effort.message[place], best_effort.size[place]);

  if (is_sent) {
    queue_remove();
  }
  return is_sent;
}

void xrce_stream_best_effort_restart(xrce_session_t * session)
{
  session->statistics.dropped += best_effort.count;
  best_effort.count = 0;
  best_effort.sequence = 0;
}

uint8_t * xrce_stream_best_effort_reserve(void)
{
  return best_effort.count < MICROROS_BEST_EFFORT_SLOTS
           ? &best_effort.message[queue_place(best_effort.count)][XRCE_MESSAGE_HEADER]
           : NULL;
}

bool xrce_stream_best_effort_commit(xrce_session_t * session, size_t size)
{
  best_effort.size[queue_place(best_effort.count)] = (uint16_t)(XRCE_MESSAGE_HEADER + size);
  ++best_effort.count;
  /* at most MICROROS_BEST_EFFORT_SLOTS rounds */
  while (best_effort.count != 0u && queue_send_oldest(session)) {
    /* until the transport refuses one, or it is the turn of another task */
  }
  return true;
}

uint8_t * xrce_stream_best_effort_spare(void)
{
  return &best_effort.message[queue_place(best_effort.count)][XRCE_MESSAGE_HEADER];
}

void xrce_stream_best_effort_send_spare(xrce_session_t * session, size_t size)
{
  (void)queue_send(/* a lost message is repeated */
                   session, best_effort.message[queue_place(best_effort.count)], XRCE_MESSAGE_HEADER + size);
}

bool xrce_output_queue_is_empty(void)
{
  return best_effort.count == 0u;
}

/* Where as many have left as there are places, or several times that, since the last look, none is seen to have left: the
 * wait is longer, never shorter. */
bool xrce_output_queue_has_passed(xrce_mark_t * mark)
{
  const uint32_t around = best_effort.head < mark->head ? (uint32_t)MICROROS_BEST_EFFORT_PLACES : 0u;
  const uint32_t left_it = around + best_effort.head - mark->head;
  const uint32_t left = mark->queued > left_it ? mark->queued - left_it : 0u;

  mark->queued = left < best_effort.count ? (uint16_t)left : best_effort.count;
  mark->head = best_effort.head;
  return mark->queued == 0u;
}

const uint8_t * xrce_output_queue_drop_oldest(void)
{
  const uint8_t * dropped = &best_effort.message[best_effort.head][XRCE_MESSAGE_HEADER];

  if (best_effort.count == 0u) {
    return NULL;
  }
  queue_remove();
  return dropped;
}

/* Where a pump has one turn, this stream leaves every other one to those after it. */
void xrce_stream_best_effort_step(xrce_session_t * session)
{
  const bool yields = best_effort.yields;
  bool continues =
    !yields && (session->state == (uint8_t)XRCE_READY || session->state == (uint8_t)XRCE_CLOSING);
  bool has_sent = false;

  best_effort.yields = false;
  while (continues && best_effort.count != 0u) { /* at most MICROROS_BEST_EFFORT_SLOTS rounds */
    if (xrce_transport_take_turn(&session->transport)) {
      continues = queue_send_oldest(session);
      has_sent = has_sent || continues;
    } else {
      continues = false;
      best_effort.yields = has_sent;
    }
  }
}
