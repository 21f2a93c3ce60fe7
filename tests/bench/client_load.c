/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The client in the bench of the client: an application of rclc with two publishers and a subscription of String.
 *
 * client_load TASK SIZE COUNT
 *   publish   ns of one rcl_publish, best effort, and of one into a reliable stream with room: medians of batches in turns
 *   best_effort, reliable   samples a second, as fast as the stream takes them: `on_full: block`
 *   echo      ns from rcl_publish to the callback of the subscription, reliable: median and 99 %
 *   datagram  ns of one send() of a datagram of SIZE bytes: what the machine takes without a client
 * SIZE is that of the serialized message in bytes. One line says what was seen.
 */
#define _POSIX_C_SOURCE 200809L
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/string.h>

#include <arpa/inet.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>

enum { SIZE_MOST = 1100, BATCH = 12, BATCHES = 1001, CDR_BESIDE = 5 };

static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t best_effort;
static rcl_publisher_t reliable;
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

static void on_message(const void * sample)
{
  (void)sample;
  ++came;
}

static void start(size_t size, bool hears)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);

  (void)memset(text, 'a', sizeof(text) - 1u);
  message.data.data = text;
  message.data.size = size - CDR_BESIDE;
  message.data.capacity = sizeof(text);
  text[message.data.size] = '\0';
  heard.data.data = heard_text;
  heard.data.capacity = sizeof(heard_text);
  check(rclc_support_init(&support, 0, NULL, &allocator));
  check(rclc_node_init_default(&node, "bench", "", &support));
  check(rclc_publisher_init_best_effort(&best_effort, &node, type, "best_effort"));
  check(rclc_publisher_init_default(&reliable, &node, type, "reliable"));
  check(rclc_executor_init(&executor, &support.context, 1, &allocator));
  if (hears) {
    check(rclc_subscription_init_default(&subscription, &node, type, "echo"));
    check(rclc_executor_add_subscription(&executor, &subscription, &heard, on_message, ON_NEW_DATA));
  }
}

/* Waits at most `wait_ns` for what comes; runs what came. */
static void spin(int64_t wait_ns)
{
  const rcl_ret_t result = rclc_executor_spin_some(&executor, (uint64_t)wait_ns);

  if (result != RCL_RET_OK && result != RCL_RET_TIMEOUT) {
    check(result);
  }
}

/* Publishes a batch, which finds room in the reliable stream; gives the ns of one. What comes back waits for the end. */
static int64_t batch(rcl_publisher_t * publisher)
{
  const int64_t from = now_ns();
  int64_t took;

  for (int k = 0; k < BATCH; ++k) {
    check(rcl_publish(publisher, &message, NULL));
  }
  took = (now_ns() - from) / BATCH;
  check(rmw_uros_flush(rcl_context_get_rmw_context(&support.context), 1000));
  return took;
}

static void publish(void)
{
  static int64_t batches[2][BATCHES];

  for (int i = 0; i < BATCHES; ++i) {
    batches[0][i] = batch(&best_effort);
    batches[1][i] = batch(&reliable);
  }
  qsort(batches[0], BATCHES, sizeof(batches[0][0]), ascending);
  qsort(batches[1], BATCHES, sizeof(batches[1][0]), ascending);
  (void)printf("%lld %lld\n", (long long)batches[0][BATCHES / 2], (long long)batches[1][BATCHES / 2]);
}

static void flood(rcl_publisher_t * publisher, unsigned long count)
{
  const int64_t from = now_ns();

  for (unsigned long i = 0; i < count; ++i) {
    check(rcl_publish(publisher, &message, NULL)); /* waits where the stream is full */
  }
  check(rmw_uros_flush(rcl_context_get_rmw_context(&support.context), 1000));
  (void)printf("%.0f\n", (double)count * 1e9 / (double)(now_ns() - from));
}

static void echo(unsigned long count)
{
  int64_t * times = calloc(count, sizeof(*times));

  if (times == NULL) {
    exit(1);
  }
  while (came == 0u) { /* until the agent knows of the subscription */
    check(rcl_publish(&reliable, &message, NULL));
    spin(10000000);
  }
  came = 0;
  for (unsigned long i = 0; i < count; ++i) {
    const int64_t from = now_ns();

    check(rcl_publish(&reliable, &message, NULL));
    while (came <= i && now_ns() - from < 1000000000) {
      spin(100000000);
    }
    times[i] = now_ns() - from;
  }
  qsort(times, count, sizeof(*times), ascending);
  (void)printf(
    "%lld %lld %lu\n", (long long)times[count / 2], (long long)times[count - count / 100 - 1], count - came);
  free(times);
}

/* To a socket of this process that nobody reads: it is full soon, and what comes then is dropped. */
static void datagram(size_t size, unsigned long count)
{
  static char bytes[SIZE_MOST];
  struct sockaddr_in to = {.sin_family = AF_INET, .sin_addr = {htonl(INADDR_LOOPBACK)}};
  socklen_t length = sizeof(to);
  const int silent = socket(AF_INET, SOCK_DGRAM, 0);
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  int64_t from;

  if (
    bind(silent, (const struct sockaddr *)&to, sizeof(to)) != 0 ||
    getsockname(silent, (struct sockaddr *)&to, &length) != 0) {
    perror("datagram");
    exit(1);
  }
  from = now_ns();
  for (unsigned long i = 0; i < count; ++i) {
    (void)sendto(descriptor, bytes, size, 0, (const struct sockaddr *)&to, sizeof(to));
  }
  (void)printf("%lld\n", (long long)((now_ns() - from) / (int64_t)count));
}

int main(int argc, char ** argv)
{
  const char * task = argc == 4 ? argv[1] : "";
  const size_t size = argc == 4 ? strtoul(argv[2], NULL, 10) : 0;
  const unsigned long count = argc == 4 ? strtoul(argv[3], NULL, 10) : 0;

  if (size <= CDR_BESIDE || size >= SIZE_MOST || count == 0) {
    return 2;
  }
  if (strcmp(task, "datagram") == 0) {
    datagram(size, count);
    return 0;
  }
  start(size, strcmp(task, "echo") == 0);
  if (strcmp(task, "publish") == 0) {
    publish();
  } else if (strcmp(task, "echo") == 0) {
    echo(count);
  } else {
    flood(strcmp(task, "reliable") == 0 ? &reliable : &best_effort, count);
  }
  return 0;
}
