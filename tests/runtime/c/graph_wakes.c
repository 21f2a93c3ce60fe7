/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An event of the graph beside an executor that has nothing to do: graph_wakes MS ROUNDS. Prints how often threads of the process
 * went to sleep within MS while the graph stayed as it was. Then the agent of test_graph_wakes.py changes the graph for each line
 * of standard output: in ROUNDS an event that is open hears of it, in others one that another thread opens.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit_spinner.h"

#include <rcl/event.h>

#include <time.h>

enum { MS_AT_MOST = 20000 };

static rcl_publisher_t publisher;
static rcl_event_t matched;
static uint32_t told; /* the lock of the port guards it */

static void on_event(const void * user_data, size_t number_of_events)
{
  (void)user_data;
  port_lock();
  told += (uint32_t)number_of_events;
  port_unlock();
}

static uint32_t told_now(void)
{
  uint32_t value;

  port_lock();
  value = told;
  port_unlock();
  return value;
}

static void open_event(void)
{
  matched = rcl_get_zero_initialized_event();
  CHECK(rcl_publisher_event_init(&matched, &publisher, RCL_PUBLISHER_MATCHED) == RCL_RET_OK);
  CHECK(rcl_event_set_callback(&matched, on_event, NULL) == RCL_RET_OK);
}

/* Calls nothing of the library. */
static void await(uint32_t before)
{
  for (uint32_t i = 0; i < 2u * (uint32_t)MS_AT_MOST && told_now() == before; ++i) {
    const struct timespec half = {0, 500000L};

    (void)nanosleep(&half, NULL);
  }
  CHECK(told_now() != before);
}

static void say(const char * word)
{
  (void)printf("%s\n", word);
  (void)fflush(stdout);
}

static void change_graph(uint32_t rounds)
{
  for (uint32_t i = 0; i < rounds; ++i) {
    const uint32_t before = told_now();

    say("change");
    await(before);
  }
}

/* An event that is opened counts what matches already. */
static void open_events(uint32_t rounds)
{
  for (uint32_t i = 0; i < rounds; ++i) {
    const uint32_t before = told_now();

    CHECK(rcl_event_fini(&matched) == RCL_RET_OK);
    open_event();
    await(before);
  }
}

int main(int count, char * arguments[])
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  uint32_t rounds;

  CHECK(count == 3);
  rounds = (uint32_t)strtoul(arguments[2], NULL, 10);
  spinner_open();
  CHECK(rclc_publisher_init_default(&publisher, &node, type, "count") == RCL_RET_OK);
  open_event();
  spinner_start();
  (void)printf("%lu\n", spinner_sleeps((uint32_t)strtoul(arguments[1], NULL, 10)));
  change_graph(rounds);
  open_events(rounds);
  say("end");
  spinner_stop();
  return 0;
}
