/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions of the library with the worst that their loops can be given: full tables that are searched to the end, names that
 * differ in their last character, all messages of a stream asked for again, bytes that each become two. Each EXTREME(function,
 * call) is between two marks, in the order of this file. The application file is that of test_extremes.py.
 */
#include "measured.h"

#include <microros/rcutils_ring.h>
#include <microros/xrce_client.h>
#include <microros/xrce_entities.h>
#include <microros/xrce_fragments.h>
#include <microros/xrce_framing.h>
#include <microros/xrce_services.h>
#include <microros/xrce_rosout.h>
#include <microros/xrce_stream_reliable.h>
#include <microros/xrce_stream_reliable_input.h>
#include <microros/xrce_wire.h>
#include <rcl/rcl.h>
#include <rcl_interfaces/msg/log.h>
#include <rclc/rclc.h>
#include <rcutils/logging.h>

enum {
  LINE_MOST = rcl_interfaces__msg__Log__MAX_ENCODED_SIZE,
  MANY = 300,
  AHEAD = 16,
  REQUEST = 1,
  OBJECT = (MICROROS_PUBLISHERS_MAX << 4) + XRCE_KIND_DATAREADER
};

#define EXTREME(function, ...) \
  do { \
    mark(); \
    (void)function(__VA_ARGS__); \
    mark(); \
  } while (0)

static xrce_client_t client;
static volatile bool is_running;
static char name[MICROROS_LOGGER_NAME_SIZE];
static uint8_t line[LINE_MOST];
static uint8_t message[MICROROS_RELIABLE_INPUT_SLOT_SIZE];

/* Every second character ends a part of the name, and each of the loggers differs from it in the last character of a part. */
static void loggers_measure(void)
{
  for (size_t i = 0; i + 1u < sizeof(name); ++i) {
    name[i] = i % 2u == 0u ? 'a' : '.';
  }
  for (size_t i = 0; i < (size_t)MICROROS_LOGGERS_MAX; ++i) {
    name[sizeof(name) - 2u] = (char)('b' + i);
    (void)rcutils_logging_set_logger_level(name, RCUTILS_LOG_SEVERITY_ERROR);
  }
  name[sizeof(name) - 2u] = 'a';
  EXTREME(rcutils_logging_get_logger_effective_level, name);
}

static void ring_measure(void)
{
  for (uint32_t i = 0; i < (uint32_t)MANY; ++i) {
    microros_ring_put(line, 0); /* lines of nothing but a header */
  }
  EXTREME(microros_ring_put, line, sizeof(line));
  EXTREME(xrce_rosout_put, line, sizeof(line));
}

static void requests_measure(void)
{
  static const xrce_endpoint_t endpoint = {
    .client = &client, .index = XRCE_REQUESTERS_AT - MICROROS_NODES_MAX};
  int64_t sequence = 0;
  uint16_t last = 1;

  xrce_requests_open(&endpoint);
  for (; last < (uint16_t)MICROROS_REQUESTS_MAX; ++last) {
    (void)xrce_requests_add(&endpoint, last);
  }
  EXTREME(xrce_requests_add, &endpoint, last);
  EXTREME(xrce_requests_add, &endpoint, (uint16_t)MANY);
  EXTREME(xrce_requests_take, &endpoint, (uint16_t)(MANY + 1), &sequence);
}

static void output_measure(void)
{
  static const uint8_t all[XRCE_ACKNACK_SIZE] = {0, 0, 0xff, 0xff, XRCE_STREAM_RELIABLE};
  xrce_stream_reliable_t * const stream = &client.reliable;

  client.session.state = (uint8_t)XRCE_READY;
  stream->count = MICROROS_RELIABLE_SLOTS;
  EXTREME(
    xrce_stream_reliable_on_acknack, stream, &client.session, all, sizeof(all), XRCE_FLAG_LITTLE_ENDIAN, 1);
}

static void input_measure(void)
{
  xrce_stream_reliable_input_t * const stream = &client.reliable_input;
  size_t size = 0;

  for (uint16_t i = 1; i < (uint16_t)XRCE_RELIABLE_INPUT_HELD; ++i) {
    xrce_stream_reliable_input_keep(stream, i, message, sizeof(message));
  }
  EXTREME(xrce_stream_reliable_input_keep, stream, XRCE_RELIABLE_INPUT_HELD, message, sizeof(message));
  EXTREME(xrce_stream_reliable_input_map, stream);
  EXTREME(xrce_stream_reliable_input_kept, stream, XRCE_RELIABLE_INPUT_HELD, &size);
}

/* Every message that the agent may send ahead is not available any more. */
static void skip_measure(void)
{
  static const uint8_t first[XRCE_HEARTBEAT_SIZE] = {AHEAD, 0, AHEAD, 0, XRCE_STREAM_RELIABLE};

  (void)memset(&client.reliable_input, 0, sizeof(client.reliable_input));
  EXTREME(xrce_stream_reliable_input_on_heartbeat, &client, first, sizeof(first), XRCE_FLAG_LITTLE_ENDIAN);
}

/* The last fragment of a sample, as large as a message can have it, for a reader. */
static void fragments_measure(void)
{
  static uint8_t fragment[MICROROS_RELIABLE_INPUT_SLOT_SIZE] = {
    XRCE_FRAGMENT, XRCE_FLAG_LITTLE_ENDIAN | XRCE_FLAG_LAST_FRAGMENT};
  xrce_fragments_t * const fragments = &client.fragments;
  xrce_receiver_t * const receiver = &client.receivers[0];

  fragments->begun = true;
  fragments->next = (uint16_t)(client.reliable_input.next - 1u);
  fragments->sample.size = sizeof(fragment) - XRCE_SUBMESSAGE_HEADER - XRCE_MESSAGE_HEADER;
  fragments->sample.request = REQUEST;
  fragments->sample.object = OBJECT;
  receiver->request = REQUEST;
  receiver->arriving = true;
  client.states[MICROROS_NODES_MAX + MICROROS_PUBLISHERS_MAX].wanted = true;
  EXTREME(
    xrce_fragments_on_fragment, &client, fragment,
    sizeof(fragment) - XRCE_SUBMESSAGE_HEADER - XRCE_MESSAGE_HEADER, 1);
}

/* A message of bytes that each become two. */
static void framing_measure(void)
{
  static uint8_t flags[MICROROS_MTU];

  (void)memset(flags, XRCE_FRAME_FLAG, sizeof(flags));
  EXTREME(xrce_framing_send, &client.session.transport, flags, sizeof(flags));
}

/* Each entity has to be created again. */
static void entities_measure(void)
{
  for (size_t i = 0; i < (size_t)XRCE_PLACES; ++i) {
    client.states[i].wanted = true;
    client.states[i].level = 1;
  }
  EXTREME(xrce_entities_renew, &client);
}

int main(void)
{
  if (is_running) { /* the tool compares the plan of an image with that of its library */
    rcl_allocator_t allocator = rcl_get_default_allocator();
    rclc_support_t support;

    (void)rclc_support_init(&support, 0, NULL, &allocator);
  }
  loggers_measure();
  ring_measure();
  requests_measure();
  output_measure();
  input_measure();
  skip_measure();
  fragments_measure();
  framing_measure();
  entities_measure();
  finish();
  return 0;
}
