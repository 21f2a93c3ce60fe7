/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A board in the bench of links: an application of rclc with a publisher and a subscription of String, both reliable.
 *
 * peer_round there back SIZE COUNT   publishes on /there, hears /back, and prints the ns of a round trip: median and 99 %
 * peer_round back there              publishes on /back what it hears on /there, until it is ended
 * SIZE is that of the serialized message in bytes.
 */
#define _POSIX_C_SOURCE 200809L
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <std_msgs/msg/string.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SIZE_MOST = 400, CDR_BESIDE = 5, AGAIN_MS = 100 };

static const int64_t MOST_NS = 10000000000;

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static rcl_subscription_t subscription;
static rclc_executor_t executor;
static char text[SIZE_MOST];
static char heard_text[SIZE_MOST];
static std_msgs__msg__String message;
static std_msgs__msg__String heard;
static unsigned long came;

static int64_t now_ns(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void check(rcl_ret_t result)
{
  if (result != RCL_RET_OK) {
    (void)fprintf(stderr, "%s\n", rcl_get_error_string().str);
    exit(1);
  }
}

static int ascending(const void * left, const void * right)
{
  const int64_t a = *(const int64_t *)left;
  const int64_t b = *(const int64_t *)right;

  return (a > b) - (a < b);
}

static void on_back(const void * sample)
{
  (void)sample;
  ++came;
}

static void on_there(const void * sample)
{
  if (rcl_publish(&publisher, sample, NULL) != RCL_RET_OK) {
    rcl_reset_error(); /* the other board misses the answer */
  }
}

static void start(const char * out, const char * in, rclc_subscription_callback_t callback)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);
  rcl_allocator_t allocator = rcl_get_default_allocator();

  heard.data.data = heard_text;
  heard.data.capacity = sizeof(heard_text);
  check(rclc_support_init(&support, 0, NULL, &allocator));
  check(rclc_node_init_default(&node, "bench", "", &support));
  check(rclc_publisher_init_default(&publisher, &node, type, out));
  check(rclc_subscription_init_default(&subscription, &node, type, in));
  check(rclc_executor_init(&executor, &support.context, 1, &allocator));
  check(rclc_executor_add_subscription(&executor, &subscription, &heard, callback, ON_NEW_DATA));
}

static void spin(int64_t wait_ms)
{
  const rcl_ret_t result = rclc_executor_spin_some(&executor, (uint64_t)RCL_MS_TO_NS(wait_ms));

  if (result != RCL_RET_OK && result != RCL_RET_TIMEOUT) {
    check(result);
  }
}

/* Until the other board answers: DDS does not repeat what was published before it knew the subscription. */
static void meet(void)
{
  while (came == 0u) {
    if (rcl_publish(&publisher, &message, NULL) != RCL_RET_OK) {
      rcl_reset_error();
    }
    spin(AGAIN_MS);
  }
  for (int i = 0; i < 10; ++i) {
    spin(AGAIN_MS);
  }
}

static void measure(unsigned long count)
{
  int64_t * times = calloc(count, sizeof(*times));

  if (times == NULL) {
    exit(1);
  }
  meet();
  came = 0;
  for (unsigned long i = 0; i < count; ++i) {
    const int64_t from = now_ns();

    check(rcl_publish(&publisher, &message, NULL));
    while (came <= i && now_ns() - from < MOST_NS) {
      spin(AGAIN_MS);
    }
    if (came <= i) {
      (void)fprintf(stderr, "no answer to message %lu\n", i);
      exit(1);
    }
    times[i] = now_ns() - from;
  }
  qsort(times, count, sizeof(*times), ascending);
  (void)printf("%lld %lld\n", (long long)times[count / 2], (long long)times[count - count / 100 - 1]);
  free(times);
}

int main(int argc, char ** argv)
{
  const size_t size = argc == 5 ? strtoul(argv[3], NULL, 10) : (size_t)CDR_BESIDE + 1u;
  const unsigned long count = argc == 5 ? strtoul(argv[4], NULL, 10) : 0;

  if (argc < 3 || size <= CDR_BESIDE || size >= SIZE_MOST) {
    return 2;
  }
  (void)memset(text, 'a', sizeof(text) - 1u);
  message.data.data = text;
  message.data.size = size - CDR_BESIDE;
  message.data.capacity = sizeof(text);
  text[message.data.size] = '\0';
  start(argv[1], argv[2], count != 0u ? on_back : on_there);
  if (count != 0u) {
    measure(count);
  }
  while (count == 0u) {
    spin(AGAIN_MS);
  }
  return 0;
}
