/* SPDX-License-Identifier: Apache-2.0 */
/* Waiting for the best-effort messages of a queue, while others write: random steps against a list. */
#include "unit.h"

#include "microros/xrce_mark.h"
#include "microros/xrce_output_queue.h"
#include "microros/xrce_session.h"
#include "microros/xrce_stream_best_effort.h"
#include "microros/xrce_stream_best_effort_queue.h"

#include <stdbool.h>
#include <stdint.h>

enum { WAITS = 20000, STEPS = 200, SIZE = 8 };

static xrce_session_t session;
static uint32_t chance = 1;
static bool is_open;     /* the transport accepts messages */
static uint32_t first;   /* the oldest message in the queue */
static uint32_t written; /* the next one */

static uint32_t below(uint32_t count)
{
  chance ^= chance << 13;
  chance ^= chance >> 17;
  chance ^= chance << 5;
  return chance % count;
}

bool xrce_session_send(xrce_session_t * sender, const uint8_t * message, size_t size)
{
  (void)sender;
  (void)message;
  (void)size;
  if (!is_open || below(3) == 0u) {
    return false;
  }
  ++first;
  return true;
}

static void write_one(void)
{
  is_open = below(2) == 0u;
  if (xrce_stream_best_effort_reserve() == NULL) {
    CHECK(xrce_output_queue_drop_oldest() != NULL);
    ++first;
  }
  ++written;
  CHECK(xrce_stream_best_effort_commit(&session, SIZE));
}

static void change(void)
{
  const uint32_t what = below(16);

  if (what == 0u) {
    xrce_stream_best_effort_restart(&session);
    first = written;
  } else if (what < 9u) {
    write_one();
  } else {
    is_open = true;
    xrce_stream_best_effort_step(&session);
  }
  CHECK(xrce_output_queue_is_empty() == (first == written));
}

/* Returns whether the wait ended. It is never over too early, and at once where each change is seen. */
static bool await(bool sees_all)
{
  const uint32_t end = written;
  xrce_mark_t mark = xrce_mark_new();
  bool found = xrce_output_queue_has_passed(&mark);

  CHECK(found == (first == end));
  for (uint32_t i = 0; i < (uint32_t)STEPS && !found; ++i) {
    change();
    if (sees_all || below(6) == 0u) {
      const bool expected = (int32_t)(first - end) >= 0;

      found = xrce_output_queue_has_passed(&mark);
      CHECK(expected || !found);
      CHECK(found == expected || !sees_all);
    }
  }
  return found;
}

int main(void)
{
  uint32_t ended = 0;

  session.state = XRCE_READY;
  session.transport_open = true;
  for (uint32_t i = 0; i < (uint32_t)WAITS; ++i) {
    ended += await(below(2) == 0u) ? 1u : 0u;
    for (uint32_t steps = below(20); steps != 0u; --steps) {
      change();
    }
  }
  CHECK(ended > WAITS * 99 / 100);
  return 0;
}
