/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Messages of the library itself, of the logger `microros`: the state of the session, and counters of what went wrong. A
 * counter that keeps growing is logged once in LIBRARY_PERIOD_MS.
 */
#include "microros/rcutils_library_log.h"

#include "microros/rcutils_console.h"
#include "microros/rcutils_format.h"
#include "microros/rcutils_rosout.h"
#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"
#include "microros_config.h"
#include "rcutils/logging.h"

enum { LIBRARY_PERIOD_MS = 1000, LIBRARY_TEXT_SIZE = 64, LIBRARY_LEVEL_STEP = 10 };

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

/* Whether messages of this level are in the image; the compiler leaves out the others. */
static inline bool library_has(int severity)
{
  return severity >= ((int)MICROROS_LOG_MIN_SEVERITY + 1) * (int)LIBRARY_LEVEL_STEP;
}

static void library_log(int severity, const char * text)
{
  static const rcutils_log_location_t location = {"microros_library_log", __FILE__, __LINE__};

  if (rcutils_logging_logger_is_enabled_for("microros", severity)) {
    microros_log_text(&location, severity, "microros", text);
  }
}

/* Logs a number with what is before and after it. */
static void library_log_number(
  int severity, const char * before, const microros_conversion_t * how, uint32_t number, const char * after)
{
  char text[LIBRARY_TEXT_SIZE];
  microros_format_t out = {text, sizeof(text) - 1u, 0, false};

  microros_format_string(&out, before);
  microros_format_integer(&out, how, number, false);
  microros_format_string(&out, after);
  text[out.used] = '\0';
  library_log(severity, text);
}

static inline void library_log_state_as(int severity, const char * text)
{
  if (library_has(severity)) {
    library_log(severity, text);
  }
}

static inline void library_log_count(int severity, const char * before, uint32_t count, const char * after)
{
  static const microros_conversion_t decimal = {false, false, false, false, false, 0, -1, '\0', 'u'};

  if (library_has(severity) && count != 0u) {
    library_log_number(severity, before, &decimal, count, after);
  }
}

static void library_log_refusal(uint8_t refusal)
{
  static const microros_conversion_t two_digits = {false, true, false, false, false, 2, -1, '\0', 'x'};

  if (refusal == library_seen.refusal) {
    return;
  }
  library_seen.refusal = refusal;
  /* cppcheck-suppress knownConditionTrueFalse ; depends on the lowest level of the plan */
  if (library_has(RCUTILS_LOG_SEVERITY_ERROR) && refusal != 0u) {
    library_log_number(
      RCUTILS_LOG_SEVERITY_ERROR, "the agent refuses the session: status 0x", &two_digits, refusal, "");
  }
}

/* Logs that the session is not ready any more, or not yet. */
static void library_log_not_ready(uint8_t before, uint8_t state)
{
  if (state == (uint8_t)XRCE_CLOSED) {
    library_log_state_as(RCUTILS_LOG_SEVERITY_INFO, "session closed");
  } else if (before == (uint8_t)XRCE_READY) {
    library_log_state_as(RCUTILS_LOG_SEVERITY_WARN, "session lost");
  } else {
    library_log_state_as(RCUTILS_LOG_SEVERITY_DEBUG, "connecting");
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
  library_log_state_as(
    RCUTILS_LOG_SEVERITY_INFO, session->statistics.reconnects == 0u ? "session open" : "session open again");
}

static void library_log_counters(const xrce_session_t * session)
{
  const uint32_t dropped = library_growth(&library_seen.dropped, session->statistics.dropped);
  const uint32_t refused = library_growth(&library_seen.refused, session->statistics.refused);
  const uint32_t malformed = library_growth(&library_seen.malformed, session->statistics.malformed);

  library_log_count(RCUTILS_LOG_SEVERITY_ERROR, "the agent refused ", refused, " requests");
  library_log_count(RCUTILS_LOG_SEVERITY_WARN, "", dropped, " samples dropped");
  library_log_count(RCUTILS_LOG_SEVERITY_WARN, "", malformed, " messages that are not valid");
}

void microros_library_log(const xrce_client_t * client)
{
  const xrce_session_t * const session = &client->session;

  microros_rosout_report();
  microros_console_report();
  library_log_refusal(session->refusal);
  library_log_state(session);
  if (session->now_ms - library_seen.since_ms >= (uint32_t)LIBRARY_PERIOD_MS) {
    library_seen.since_ms = session->now_ms;
    library_log_counters(session);
  }
}
