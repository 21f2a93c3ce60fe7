/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the library itself logs, as much as there can be in one hold of the lock: the session is open again, it is refused, and
 * all three counters have grown. Between each two marks is one such call: with room for the lines, and without.
 */
#include "measured.h"

#include <microros/port_console.h>
#include <microros/rcutils_library_log.h>
#include <microros/xrce_client.h>
#include <microros/xrce_wire.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>

enum { CALLS = 16, BLOCKED_FROM = 6, BLOCKED_TO = 10, PERIOD_MS = 1000 };

static xrce_client_t client;
static bool is_blocked;
static volatile bool is_running;

bool port_console_write(const char * line, size_t size)
{
  (void)line;
  (void)size;
  return !is_blocked;
}

int main(void)
{
  if (is_running) { /* the tool compares the plan of an image with that of its library */
    rcl_allocator_t allocator = rcl_get_default_allocator();
    rclc_support_t support;

    (void)rclc_support_init(&support, 0, NULL, &allocator);
  }
  for (uint32_t i = 0; i < (uint32_t)CALLS; ++i) {
    xrce_session_t * const session = &client.session;

    is_blocked = i >= (uint32_t)BLOCKED_FROM && i < (uint32_t)BLOCKED_TO;
    session->state = i % 2u == 0u ? (uint8_t)XRCE_READY : (uint8_t)XRCE_CLOSED;
    session->refusal = (uint8_t)(0x81u + i);
    session->now_ms += (uint32_t)PERIOD_MS;
    session->statistics.reconnects = 1;
    session->statistics.dropped += UINT32_MAX - 1u;
    session->statistics.refused += UINT32_MAX - 1u;
    session->statistics.malformed += UINT32_MAX - 1u;
    mark();
    microros_library_log(&client);
    mark();
  }
  finish();
  return 0;
}
