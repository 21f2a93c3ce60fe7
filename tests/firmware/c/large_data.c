/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Gives each image back without a copy: it is taken as a loan, and its bytes go from the queue into the fragments that
 * are sent. `large_data_report`: images taken, images sent, the last error.
 */
#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <sensor_msgs/msg/image.h>

#include <string.h>

enum { TAKEN, SENT, ERROR, REPORTS };
enum { EMPTY_SEQUENCE = 4, STEP = 1000 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rcl_allocator_t allocator;
static const sensor_msgs__msg__Image * image;

volatile uint32_t large_data_report[REPORTS];

static void add_size(uint32_t * topic_length)
{
  *topic_length += (uint32_t)image->data.size;
}

static void write_data(ucdrBuffer * ucdr)
{
  const size_t size = image->data.size;

  ucdr->iterator -= EMPTY_SEQUENCE;
  ucdr->offset -= EMPTY_SEQUENCE;
  (void)ucdr_serialize_uint32_t(ucdr, (uint32_t)size);
  for (size_t at = 0; at < size; at += STEP) {
    (void)ucdr_serialize_array_uint8_t(ucdr, &image->data.data[at], size - at < STEP ? size - at : STEP);
  }
}

static bool open_all(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, Image);

  return rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK &&
         rclc_node_init_default(&node, "mirror", "", &support) == RCL_RET_OK &&
         rclc_publisher_init_default(&publisher, &node, type, "/large_out") == RCL_RET_OK &&
         rclc_subscription_init_default(&subscription, &node, type, "/large_in") == RCL_RET_OK;
}

static rcl_ret_t mirror(void)
{
  sensor_msgs__msg__Image reply = *image;

  reply.data.data = NULL;
  reply.data.size = 0;
  reply.data.capacity = 0;
  return rcl_publish(&publisher, &reply, NULL);
}

int main(void)
{
  allocator = rcl_get_default_allocator();
  while (!open_all()) {
    /* the agent is not there yet */
  }
  rmw_uros_set_continous_serialization_callbacks(
    rcl_publisher_get_rmw_handle(&publisher), add_size, write_data);
  for (;;) {
    void * loan = NULL;

    if (rcl_take_loaned_message(&subscription, &loan, NULL, NULL) == RCL_RET_OK) {
      rcl_ret_t result;

      image = loan;
      ++large_data_report[TAKEN];
      result = mirror();
      if (result == RCL_RET_OK) {
        ++large_data_report[SENT];
      } else {
        large_data_report[ERROR] = (uint32_t)result;
      }
      (void)rcl_return_loaned_message_from_subscription(&subscription, loan);
    }
  }
}
