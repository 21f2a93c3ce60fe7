/* SPDX-License-Identifier: Apache-2.0 */
/*
 * continuous PORT: for each line of the standard input, publishes on the declared topics and prints the result:
 * "text N" a std_msgs/String of N characters, "image N" a sensor_msgs/Image of N bytes, both in parts of 100 bytes;
 * "few N" and "many N" write one byte less and more than promised; "nested N" publishes another message within;
 * "fast N" has callbacks of a best-effort publisher; "plain N" publishes a number without callbacks; "spin N" runs for N
 * milliseconds. "pause N" waits N milliseconds after the first half of the next message, and prints a line before.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <sensor_msgs/msg/image.h>
#include <std_msgs/msg/int32.h>
#include <std_msgs/msg/string.h>

enum { PART = 100, EMPTY_STRING = 5, EMPTY_SEQUENCE = 4 };

static rclc_support_t support;
static rcl_init_options_t options;
static rcl_node_t node;
static rcl_publisher_t texts;
static rcl_publisher_t images;
static rcl_publisher_t fast;
static rcl_publisher_t numbers;
static std_msgs__msg__Int32 number;
static uint32_t length;
static int pause_ms;
static int more; /* bytes written beside those promised */
static bool nested;

static rcl_ret_t set_up(const char * port)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  rcl_ret_t result;

  (void)port;
  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  options = rcl_get_zero_initialized_init_options();
  result = rcl_init_options_init(&options, allocator);
#ifndef CONTINUOUS_LINE
  if (result == RCL_RET_OK) {
    result =
      rmw_uros_options_set_udp_address("127.0.0.1", port, rcl_init_options_get_rmw_init_options(&options));
  }
#endif
  if (result == RCL_RET_OK) {
    result = rclc_support_init_with_options(&support, 0, NULL, &options, &allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "camera", "", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init(
      &texts, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String), "continuous_text", &qos);
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init(
      &images, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, Image), "continuous_image", &qos);
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init_best_effort(
      &fast, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String), "continuous_fast");
  }
  if (result == RCL_RET_OK) {
    result = rclc_publisher_init(
      &numbers, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "continuous_number", &qos);
  }
  return result;
}

static void size_of(uint32_t * topic_length)
{
  *topic_length += length;
}

static void write_bytes(ucdrBuffer * ucdr, uint32_t first, uint32_t span)
{
  uint8_t part[PART];
  const uint32_t all = (uint32_t)((int)length + more);

  for (uint32_t at = 0; at < all; at += PART) {
    const uint32_t size = all - at < PART ? all - at : PART;

    if (pause_ms != 0 && at >= all / 2u) {
      (void)printf("half\n");
      (void)fflush(stdout);
      rclc_sleep_ms((unsigned)pause_ms);
      pause_ms = 0;
    }
    for (uint32_t i = 0; i < size; ++i) {
      part[i] = (uint8_t)(first + (at + i + (at + i) / 97u) % span);
    }
    if (!ucdr_serialize_array_uint8_t(ucdr, part, size)) {
      return;
    }
    if (nested && at == 0u && rcl_publish(&numbers, &number, NULL) != RCL_RET_OK) {
      (void)printf("nested: %s\n", rcl_get_error_string().str);
    }
  }
}

static void write_text(ucdrBuffer * ucdr)
{
  ucdr->iterator -= EMPTY_STRING;
  ucdr->offset -= EMPTY_STRING;
  (void)ucdr_serialize_uint32_t(ucdr, length + 1u);
  write_bytes(ucdr, 'a', 26);
  (void)ucdr_serialize_char(ucdr, '\0');
}

static void write_image(ucdrBuffer * ucdr)
{
  ucdr->iterator -= EMPTY_SEQUENCE;
  ucdr->offset -= EMPTY_SEQUENCE;
  (void)ucdr_serialize_uint32_t(ucdr, length);
  write_bytes(ucdr, 0, 256);
}

static rcl_ret_t publish(
  const rcl_publisher_t * publisher, const void * message, rmw_uros_continous_serialization callback)
{
  rcl_ret_t result;

  rmw_uros_set_continous_serialization_callbacks(rcl_publisher_get_rmw_handle(publisher), size_of, callback);
  result = rcl_publish(publisher, message, NULL);
  rmw_uros_set_continous_serialization_callbacks(rcl_publisher_get_rmw_handle(publisher), NULL, NULL);
  return result;
}

static rcl_ret_t publish_text(const rcl_publisher_t * publisher)
{
  static char none[1];
  std_msgs__msg__String message = {{none, 0, sizeof(none)}};

  return publish(publisher, &message, write_text);
}

static rcl_ret_t publish_image(void)
{
  static char frame[] = "eye";
  static char encoding[] = "mono8";
  static uint8_t none[1];
  sensor_msgs__msg__Image message;

  (void)memset(&message, 0, sizeof(message));
  message.header.frame_id.data = frame;
  message.header.frame_id.size = 3;
  message.header.frame_id.capacity = sizeof(frame);
  message.encoding.data = encoding;
  message.encoding.size = 5;
  message.encoding.capacity = sizeof(encoding);
  message.data.data = none;
  message.data.capacity = sizeof(none);
  message.height = 1;
  message.width = length;
  message.step = length;
  return publish(&images, &message, write_image);
}

static rcl_ret_t run(const char * what)
{
  more = strcmp(what, "few") == 0 ? -1 : strcmp(what, "many") == 0 ? 1 : 0;
  nested = strcmp(what, "nested") == 0;
  number.data = (int32_t)length;
  if (strcmp(what, "image") == 0) {
    return publish_image();
  }
  if (strcmp(what, "plain") == 0) {
    return rcl_publish(&numbers, &number, NULL);
  }
  if (strcmp(what, "spin") == 0) {
    for (uint32_t i = 0; i < length; ++i) {
      (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
      rclc_sleep_ms(1);
    }
    return RCL_RET_OK;
  }
  return publish_text(strcmp(what, "fast") == 0 ? &fast : &texts);
}

int main(int count, char ** arguments)
{
  char what[16];
  unsigned value;

  if (set_up(count > 1 ? arguments[1] : "") != RCL_RET_OK) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    return 1;
  }
  (void)printf("ready\n");
  (void)fflush(stdout);
  while (scanf("%15s %u", what, &value) == 2) {
    rmw_uros_statistics_t statistics;
    rcl_ret_t result;

    if (strcmp(what, "pause") == 0) {
      pause_ms = (int)value;
      continue;
    }
    length = value;
    rcl_reset_error();
    result = run(what);
    (void)rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics);
    (void)printf(
      "%d %u %s\n", (int)result, (unsigned)statistics.dropped,
      result == RCL_RET_OK ? "" : rcl_get_error_string().str);
    (void)fflush(stdout);
  }
  return rcl_publisher_fini(&texts, &node) != RCL_RET_OK ||
         rcl_publisher_fini(&images, &node) != RCL_RET_OK || rcl_publisher_fini(&fast, &node) != RCL_RET_OK ||
         rcl_publisher_fini(&numbers, &node) != RCL_RET_OK || rcl_node_fini(&node) != RCL_RET_OK ||
         rclc_support_fini(&support) != RCL_RET_OK;
}
