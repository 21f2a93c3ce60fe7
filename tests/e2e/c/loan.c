/* SPDX-License-Identifier: Apache-2.0 */
/*
 * loan PORT: subscribes to images, and for each line of the standard input prints what a call gave:
 * "take" a loan, with size, width, encoding, and a sum of its bytes; "look" the same of the loan that is out; "return" it;
 * "again" takes one more; "copy" takes with rcl_take; "spin N" receives for N milliseconds; "close" and "open".
 */
#include <inttypes.h>
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

static rclc_support_t support;
static rcl_init_options_t options;
static rcl_node_t node;
static rcl_subscription_t images;
static rcl_subscription_t numbers;
static void * loan;

static rcl_ret_t open_images(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, Image);

#ifdef LOAN_BEST_EFFORT
  return rclc_subscription_init_best_effort(&images, &node, type, "loan_image");
#else
  return rclc_subscription_init_default(&images, &node, type, "loan_image");
#endif
}

static rcl_ret_t set_up(const char * port)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result;

  options = rcl_get_zero_initialized_init_options();
  result = rcl_init_options_init(&options, allocator);
  if (result == RCL_RET_OK) {
    result =
      rmw_uros_options_set_udp_address("127.0.0.1", port, rcl_init_options_get_rmw_init_options(&options));
  }
  if (result == RCL_RET_OK) {
    result = rclc_support_init_with_options(&support, 0, NULL, &options, &allocator);
  }
  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "screen", "", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_subscription_init_default(
      &numbers, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32), "loan_number");
  }
  return result == RCL_RET_OK ? open_images() : result;
}

static void show(const sensor_msgs__msg__Image * image)
{
  uint32_t sum = 0;

  for (size_t i = 0; i < image->data.size; ++i) {
    sum = sum * 31u + image->data.data[i];
  }
  printf(
    "%zu %" PRIu32 " %s %s %" PRIu32 " ", image->data.size, image->width, image->encoding.data,
    image->header.frame_id.data, sum);
}

static rcl_ret_t take(void ** message)
{
  const rcl_ret_t result = rcl_take_loaned_message(&images, message, NULL, NULL);

  if (result == RCL_RET_OK) {
    show(*message);
  }
  return result;
}

static rcl_ret_t run(const char * what, int value)
{
  void * second = NULL;

  if (strcmp(what, "take") == 0) {
    return take(&loan);
  }
  if (strcmp(what, "again") == 0) {
    return take(&second);
  }
  if (strcmp(what, "look") == 0) {
    show(loan);
    return RCL_RET_OK;
  }
  if (strcmp(what, "return") == 0) {
    const rcl_ret_t result = rcl_return_loaned_message_from_subscription(&images, loan);

    loan = NULL;
    return result;
  }
  if (strcmp(what, "other") == 0) {
    printf(
      "%d %d ", rcl_subscription_can_loan_messages(&images), rcl_subscription_can_loan_messages(&numbers));
    return rcl_take_loaned_message(&numbers, &second, NULL, NULL);
  }
  if (strcmp(what, "copy") == 0) {
    sensor_msgs__msg__Image image;

    (void)memset(&image, 0, sizeof(image));
    return rcl_take(&images, &image, NULL, NULL);
  }
  if (strcmp(what, "close") == 0) {
    return rcl_subscription_fini(&images, &node);
  }
  if (strcmp(what, "open") == 0) {
    return open_images();
  }
  for (int i = 0; i < value; ++i) {
    (void)rmw_uros_spin_once(rcl_context_get_rmw_context(&support.context));
    rclc_sleep_ms(1);
  }
  return RCL_RET_OK;
}

int main(int count, char ** arguments)
{
  char what[16];
  int value;

  if (count != 2 || set_up(arguments[1]) != RCL_RET_OK) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    return 1;
  }
  (void)printf("ready\n");
  (void)fflush(stdout);
  while (scanf("%15s %d", what, &value) == 2) {
    rcl_ret_t result;

    rcl_reset_error();
    result = run(what, value);
    (void)printf("%d\n", (int)result);
    (void)fflush(stdout);
  }
  return rcl_subscription_fini(&images, &node) != RCL_RET_OK ||
         rcl_subscription_fini(&numbers, &node) != RCL_RET_OK || rcl_node_fini(&node) != RCL_RET_OK ||
         rclc_support_fini(&support) != RCL_RET_OK;
}
