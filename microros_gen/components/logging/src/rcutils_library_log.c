/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages of the library itself, of the logger `microros`: the state of the session, and counters of what went wrong. A
 * counter that keeps growing is logged once in LIBRARY_PERIOD_MS.
 */
#include "microros/rcutils_library_log.h"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"
#include "rcutils/logging_macros.h"

enum { LIBRARY_PERIOD_MS = 1000 };

typedef struct library_seen_t {
  uint32_t dropped;
  uint32_t refused;
  uint32_t malformed;
  uint32_t since_ms; /* when counters were logged */
  uint8_t state;
  uint8_t refusal;
} library_seen_t;

static library_seen_t library_seen = {.state = (uint8_t)XRCE_CLOSED};

/* Returns how much a counter has grown since the last call; a new context begins with 0. */
static uint32_t library_growth(uint32_t * seen, uint32_t count)
{
  const uint32_t growth = count >= *seen ? count - *seen : count;

  *seen = count;
  return growth;
}

static void library_log_refusal(uint8_t refusal)
{
  if (refusal == library_seen.refusal) {
    return;
  }
  library_seen.refusal = refusal;
  if (refusal != 0u) {
    RCUTILS_LOG_ERROR_NAMED("microros", "the agent refuses the session: status 0x%02x", (unsigned)refusal);
  }
}

/* Logs that the session is not ready any more, or not yet. */
static void library_log_not_ready(uint8_t before, uint8_t state)
{
  if (state == (uint8_t)XRCE_CLOSED) {
    RCUTILS_LOG_INFO_NAMED("microros", "session closed");
  } else if (before == (uint8_t)XRCE_READY) {
    RCUTILS_LOG_WARN_NAMED("microros", "session lost");
  } else {
    RCUTILS_LOG_DEBUG_NAMED("microros", "connecting");
  }
}

static void library_log_state(const xrce_session_t * session)
{
  const uint8_t before = library_seen.state;

  if (session->state == before || session->state == (uint8_t)XRCE_CLOSING) {
    return;
  }
  library_seen.state = session->state;
  if (session->state != (uint8_t)XRCE_READY) {
    library_log_not_ready(before, session->state);
    return;
  }
  RCUTILS_LOG_INFO_NAMED(
    "microros", "%s", session->statistics.reconnects == 0u ? "session open" : "session open again");
}

static void library_log_counters(const xrce_session_t * session)
{
  const uint32_t dropped = library_growth(&library_seen.dropped, session->statistics.dropped);
  const uint32_t refused = library_growth(&library_seen.refused, session->statistics.refused);
  const uint32_t malformed = library_growth(&library_seen.malformed, session->statistics.malformed);

  if (refused != 0u) {
    RCUTILS_LOG_ERROR_NAMED("microros", "the agent refused %u requests", (unsigned)refused);
  }
  if (dropped != 0u) {
    RCUTILS_LOG_WARN_NAMED("microros", "%u samples dropped", (unsigned)dropped);
  }
  if (malformed != 0u) {
    RCUTILS_LOG_WARN_NAMED("microros", "%u messages that are not valid", (unsigned)malformed);
  }
}

void microros_library_log(const xrce_client_t * client)
{
  const xrce_session_t * const session = &client->session;

  library_log_refusal(session->refusal);
  library_log_state(session);
  if (session->now_ms - library_seen.since_ms >= (uint32_t)LIBRARY_PERIOD_MS) {
    library_seen.since_ms = session->now_ms;
    library_log_counters(session);
  }
}
