/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A line that takes 20 ms for each 64 bytes, and a task that publishes each millisecond: task_slow_line PORT. Prints the
 * runs of the task, those that were left out, the writes, the most runs in one write, the longest time of the processor for
 * which a task held the library's lock, in microseconds, the dropped messages, and the jitter: by how many microseconds half
 * of the times between two runs differ from a millisecond at most. With -DPLAIN=1 a loop publishes instead, in the program
 * without tasks. The application files are those of test_task_slow_line.py.
 */
#define _GNU_SOURCE
#include "unit.h"

#include <arpa/inet.h>
#include <microros/port.h>
#include <pthread.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>
#include <std_msgs/msg/int32.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <inttypes.h>
#include <stdbool.h>

#ifndef PLAIN
#define PLAIN 0
#endif
#if !PLAIN
#include <microros/tasks.h>
#endif

enum {
  WRITES = 40,
  BYTES = 64,
  US_PER_BYTES = 20000,
  PERIOD_US = 1000,
  US_PER_S = 1000000,
  NS_PER_US = 1000,
  MOST_S = 60,
  INTERVALS = 1024
};

static int agent = -1;
static rcl_publisher_t fast;
static rcl_publisher_t kept;
static volatile unsigned runs;
static volatile unsigned writes;
static volatile unsigned most_in_a_write;
static volatile bool is_saturated;
static uint64_t last_run_us;
static uint32_t
  deviations_us[INTERVALS]; /* the first ones beside the full line, of the thread that publishes */
static size_t interval_count;

/* The lock of the port, which measures. */
static pthread_mutex_t lock;
static volatile unsigned depth;
static volatile pthread_t owner;
static uint64_t locked_us;
static uint64_t longest_us;

static uint64_t microseconds(clockid_t clock)
{
  struct timespec now;

  CHECK(clock_gettime(clock, &now) == 0);
  return (uint64_t)now.tv_sec * US_PER_S + (uint64_t)now.tv_nsec / NS_PER_US;
}

void port_lock(void)
{
  CHECK(pthread_mutex_lock(&lock) == 0);
  if (depth == 0u) {
    owner = pthread_self();
    locked_us = microseconds(CLOCK_THREAD_CPUTIME_ID);
  }
  ++depth;
}

static bool is_locked_here(void)
{
  return depth != 0u && pthread_equal(owner, pthread_self()) != 0;
}

void port_unlock(void)
{
  --depth;
  if (depth == 0u && is_saturated) {
    const uint64_t held_us = microseconds(CLOCK_THREAD_CPUTIME_ID) - locked_us;

    longest_us = held_us > longest_us ? held_us : longest_us;
  }
  CHECK(pthread_mutex_unlock(&lock) == 0);
}

static void sleep_us(uint64_t time_us)
{
  const struct timespec pause = {(time_t)(time_us / US_PER_S), (long)(time_us % US_PER_S * NS_PER_US)};

  (void)nanosleep(&pause, NULL);
}

static bool line_open(struct uxrCustomTransport * transport)
{
  (void)transport;
  return true;
}

/* With tasks nobody may hold the lock for as long as this takes. */
static size_t line_write(
  struct uxrCustomTransport * transport, const uint8_t * buffer, size_t length, uint8_t * error)
{
  const unsigned before = runs;

  (void)transport;
  *error = 0;
  CHECK(PLAIN || !is_saturated || !is_locked_here());
  sleep_us((length + BYTES - 1u) / BYTES * US_PER_BYTES);
  if (is_saturated) {
    const unsigned during = runs - before;

    most_in_a_write = during > most_in_a_write ? during : most_in_a_write;
    ++writes;
  }
  return send(agent, buffer, length, 0) == (ssize_t)length ? length : 0u;
}

static size_t line_read(
  struct uxrCustomTransport * transport, uint8_t * buffer, size_t length, int timeout, uint8_t * error)
{
  const ssize_t size = recv(agent, buffer, length, MSG_DONTWAIT);

  (void)transport;
  (void)timeout;
  *error = 0;
  return size > 0 ? (size_t)size : 0u;
}

/* Called by the thread that publishes. */
static void measure(void)
{
  const uint64_t now_us = microseconds(CLOCK_MONOTONIC);

  if (is_saturated && last_run_us != 0u && interval_count < (size_t)INTERVALS) {
    const int64_t late_us = (int64_t)(now_us - last_run_us) - PERIOD_US;

    deviations_us[interval_count] = (uint32_t)(late_us < 0 ? -late_us : late_us);
    ++interval_count;
  }
  last_run_us = is_saturated ? now_us : 0u;
}

static int compare(const void * a, const void * b)
{
  const uint32_t left = *(const uint32_t *)a;
  const uint32_t right = *(const uint32_t *)b;

  return (int)(left > right) - (int)(left < right);
}

static uint32_t median_jitter_us(void)
{
  CHECK(interval_count > 0u);
  qsort(deviations_us, interval_count, sizeof(deviations_us[0]), compare);
  return deviations_us[interval_count / 2u];
}

/* What does not fit replaces the oldest one (`on_full: drop_oldest`). */
static void publish(void)
{
  static int32_t count;
  const std_msgs__msg__Int32 message = {.data = count};

  measure();
  CHECK(rcl_publish(&fast, &message, NULL) == RCL_RET_OK);
  if (count % 64 == 0) {
    CHECK(rcl_publish(&kept, &message, NULL) == RCL_RET_OK);
  }
  ++count;
  ++runs;
}

static bool goes_on(uint64_t begin_us)
{
  CHECK(microseconds(CLOCK_MONOTONIC) - begin_us < (uint64_t)MOST_S * US_PER_S);
  return writes < (unsigned)WRITES;
}

#if PLAIN
/* The same period, as well as the calls permit. */
static uint32_t publish_for_a_while(rclc_support_t * support)
{
  const uint64_t begin_us = microseconds(CLOCK_MONOTONIC);
  uint64_t next_us = begin_us;
  uint32_t missed = 0;

  (void)support;
  is_saturated = true;
  while (goes_on(begin_us)) {
    uint64_t now_us;

    publish();
    next_us += PERIOD_US;
    now_us = microseconds(CLOCK_MONOTONIC);
    for (; next_us <= now_us; next_us += PERIOD_US) {
      ++missed;
    }
    sleep_us(next_us - now_us);
  }
  is_saturated = false;
  return missed;
}
#else
static void on_release(uint8_t task)
{
  (void)task;
  publish();
}

static uint32_t publish_for_a_while(rclc_support_t * support)
{
  static rclc_executor_t executor;
  const uint64_t begin_us = microseconds(CLOCK_MONOTONIC);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_task_counters_t counters;

  executor = rclc_executor_get_zero_initialized_executor();
  CHECK(rclc_executor_init(&executor, &support->context, 1, &allocator) == RCL_RET_OK);
  CHECK(rclc_task_set_executor(RCLC_TASK_CONTROL, &executor, on_release) == RCL_RET_OK);
  CHECK(rclc_tasks_start() == RCL_RET_OK);
  do { /* before its first round each task sends by itself */
    port_sleep_ms(1);
    CHECK(rclc_task_get_counters(RCLC_TASK_LINE, &counters) == RCL_RET_OK);
    CHECK(microseconds(CLOCK_MONOTONIC) - begin_us < (uint64_t)MOST_S * US_PER_S);
  } while (counters.runs == 0u);
  is_saturated = true;
  while (goes_on(begin_us)) {
    port_sleep_ms(10);
  }
  is_saturated = false;
  CHECK(rclc_tasks_stop() == RCL_RET_OK);
  CHECK(rclc_task_get_counters(RCLC_TASK_CONTROL, &counters) == RCL_RET_OK);
  CHECK(counters.failed == 0u && counters.runs == runs);
  return counters.missed;
}
#endif

static void connect_agent(const char * port)
{
  struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons((uint16_t)atoi(port))};

  CHECK(inet_pton(AF_INET, "127.0.0.1", &address.sin_addr) == 1);
  agent = socket(AF_INET, SOCK_DGRAM, 0);
  CHECK(agent >= 0 && connect(agent, (struct sockaddr *)&address, sizeof(address)) == 0);
}

int main(int count, char * arguments[])
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  pthread_mutexattr_t kind;
  rclc_support_t support;
  rcl_node_t node = rcl_get_zero_initialized_node();
  rmw_uros_statistics_t statistics;
  uint32_t missed;

  CHECK(count == 2);
  CHECK(
    pthread_mutexattr_init(&kind) == 0 && pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE) == 0 &&
    pthread_mutex_init(&lock, &kind) == 0);
  connect_agent(arguments[1]);
  CHECK(
    rmw_uros_set_custom_transport(false, NULL, line_open, line_open, line_write, line_read) == RMW_RET_OK);
  CHECK(rclc_support_init(&support, 0, NULL, &allocator) == RCL_RET_OK);
  CHECK(rclc_node_init_default(&node, "device", "", &support) == RCL_RET_OK);
  CHECK(rclc_publisher_init_best_effort(&fast, &node, type, "fast") == RCL_RET_OK);
  CHECK(rclc_publisher_init_default(&kept, &node, type, "kept") == RCL_RET_OK);
  missed = publish_for_a_while(&support);
  CHECK(rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics) == RMW_RET_OK);
  (void)printf(
    "%u %" PRIu32 " %u %u %" PRIu64 " %" PRIu32 " %" PRIu32 "\n", runs, missed, writes, most_in_a_write,
    longest_us, statistics.dropped, median_jitter_us());
  return 0;
}
