/* SPDX-License-Identifier: Apache-2.0 */
/* A clock for the wall: date and time of day as the agent has them, every second, from one question at the start. */
#include "../example.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rclc/sleep.h>
#include <rmw_microros/rmw_microros.h>

#include <time.h>

enum { TIMEOUT_MS = 1000, MS_PER_S = 1000 };

static rclc_support_t support;
static rcl_node_t node;

static void print_time(int64_t epoch_ms)
{
  const time_t seconds = (time_t)(epoch_ms / MS_PER_S);
  const struct tm * utc = gmtime(&seconds);
  char text[32];

  if (utc != NULL && strftime(text, sizeof(text), "%Y-%m-%d %H:%M:%S", utc) > 0) {
    (void)printf("%s.%03d UTC\n", text, (int)(epoch_ms % MS_PER_S));
  }
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  example_begin();
  example_check(rclc_support_init(&support, 0, NULL, &allocator), "support");
  example_check(rclc_node_init_default(&node, "wall_clock", "", &support), "node");
  while (example_runs() && rmw_uros_sync_session(TIMEOUT_MS) != RMW_RET_OK) {
    (void)printf("the agent has not said yet what time it is\n");
  }
  while (example_runs()) {
    const int64_t now = rmw_uros_epoch_millis();

    print_time(now);
    rclc_sleep_ms((unsigned int)(MS_PER_S - now % MS_PER_S)); /* to the next full second */
  }
  example_check(rcl_node_fini(&node), "end of the node");
  example_check(rclc_support_fini(&support), "end of the support");
  return EXIT_SUCCESS;
}
