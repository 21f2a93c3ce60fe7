/* SPDX-License-Identifier: Apache-2.0 */
/* A publisher with callbacks of continuous serialization in the hands of the test: one call for each line. */
#include "fake_no_wait.h"
#include "fake_program.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/u_int8_multi_array.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rclc_support_t support;
static rcl_allocator_t allocator;
static rcl_node_t node;
static rcl_publisher_t publisher;
static std_msgs__msg__UInt8MultiArray message;
static uint8_t none[1];
static uint32_t added;
static uint32_t back;
static uint32_t count;
static const char * kind;

static rcl_ret_t init(void)
{
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  message.data.data = none;
  message.data.capacity = sizeof(none);
  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "camera", "", &support);
  }
  return result == RCL_RET_OK
           ? rclc_publisher_init_default(
               &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, UInt8MultiArray), "frames")
           : result;
}

static void add_size(uint32_t * topic_length)
{
  *topic_length += added;
}

/* One value of each type, with padding between them. */
static void write_values(ucdrBuffer * ucdr)
{
  static const uint16_t words[] = {0x0102, 0x0304, 0x0506};
  static const double reals[] = {0.5, -2.0};

  (void)ucdr_serialize_bool(ucdr, true);
  (void)ucdr_serialize_int16_t(ucdr, -2);
  (void)ucdr_serialize_char(ucdr, 'x');
  (void)ucdr_serialize_uint64_t(ucdr, UINT64_C(0x0102030405060708));
  (void)ucdr_serialize_int8_t(ucdr, -1);
  (void)ucdr_serialize_float(ucdr, 1.5f);
  (void)ucdr_serialize_uint8_t(ucdr, 7);
  (void)ucdr_serialize_sequence_uint16_t(ucdr, words, 3);
  (void)ucdr_serialize_int64_t(ucdr, -3);
  (void)ucdr_serialize_string(ucdr, "abc");
  (void)ucdr_serialize_array_double(ucdr, reals, 2);
  ucdr->endianness = UCDR_BIG_ENDIANNESS;
  (void)ucdr_serialize_array_uint16_t(ucdr, words, 3);
  (void)ucdr_serialize_int32_t(ucdr, 0x01020304);
  ucdr->endianness = UCDR_LITTLE_ENDIANNESS;
  ucdr_align_to(ucdr, 8);
}

static void write_rest(ucdrBuffer * ucdr)
{
  ucdr->iterator -= back;
  ucdr->offset -= back;
  if (strcmp(kind, "values") == 0) {
    write_values(ucdr);
    return;
  }
  for (uint32_t i = 0; i < count && ucdr_serialize_uint8_t(ucdr, (uint8_t)(i + i / 251u)); ++i) {
    if (strcmp(kind, "inside") == 0 && i == count / 2u) {
      printf("inside %d\n", (int)rcl_publish(&publisher, &message, NULL));
      kind = "";
    }
  }
}

/* KIND ADDED COUNT BACK */
static rcl_ret_t publish(void)
{
  kind = strtok(NULL, " ");
  added = (uint32_t)strtoul(strtok(NULL, " "), NULL, 10);
  count = (uint32_t)strtoul(strtok(NULL, " "), NULL, 10);
  back = (uint32_t)strtoul(strtok(NULL, " "), NULL, 10);
  return rcl_publish(&publisher, &message, NULL);
}

static rcl_ret_t call(char * line)
{
  const char * word = strtok(line, " ");
  rmw_uros_statistics_t statistics;

  if (strcmp(word, "init") == 0) {
    return init();
  }
  if (strcmp(word, "set") == 0) {
    rmw_uros_set_continous_serialization_callbacks(
      rcl_publisher_get_rmw_handle(&publisher), add_size, write_rest);
    return RCL_RET_OK;
  }
  if (strcmp(word, "unset") == 0) {
    rmw_uros_set_continous_serialization_callbacks(rcl_publisher_get_rmw_handle(&publisher), NULL, NULL);
    rmw_uros_set_continous_serialization_callbacks(NULL, add_size, write_rest);
    return RCL_RET_OK;
  }
  if (strcmp(word, "publish") == 0) {
    return publish();
  }
  if (strcmp(word, "again") == 0) {
    const rcl_ret_t result = rcl_publisher_fini(&publisher, &node);

    return result == RCL_RET_OK
             ? rclc_publisher_init_default(
                 &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, UInt8MultiArray), "frames")
             : result;
  }
  if (strcmp(word, "dropped") == 0) {
    (void)rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics);
    printf("dropped %" PRIu32 "\n", statistics.dropped);
    return RCL_RET_OK;
  }
  if (strcmp(word, "buffer") == 0) {
    uint8_t bytes[6] = {0};
    bool done[3];
    ucdrBuffer ucdr;

    ucdr_init_buffer(&ucdr, bytes, sizeof(bytes));
    done[0] = ucdr_serialize_uint8_t(&ucdr, 1);
    done[1] = ucdr_serialize_uint32_t(&ucdr, UINT32_MAX);
    done[2] = ucdr_serialize_uint8_t(&ucdr, 3);
    printf(
      "%d %d %d %zu %02x%02x\n", done[0], done[1], done[2], ucdr_buffer_length(&ucdr), bytes[0], bytes[1]);
    return RCL_RET_OK;
  }
  return rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
}

static void work(char * line)
{
  report_result(call(line));
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  return run_calls(work);
}
