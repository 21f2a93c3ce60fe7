/*
 * An application for simulation_node, to start from: copy it out of this folder and change it.
 * It looks every EXAMPLE_PERIOD_MS milliseconds what time it is on /clock.
 */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>

#include <stdint.h>
#include <stdio.h>

#ifndef EXAMPLE_PERIOD_MS
#define EXAMPLE_PERIOD_MS 100
#endif

/* How often it does so before it ends: here, for years. */
#ifndef EXAMPLE_SAMPLES
#define EXAMPLE_SAMPLES UINT32_MAX
#endif

static rclc_support_t support;
static rclc_executor_t executor;
static rcl_node_t node;

static rcl_ret_t application_init(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "simulation_node", "", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_executor_init(&executor, &support.context, 1, &allocator);
  }
  return result;
}

static void application_fini(void)
{
  (void)rclc_executor_fini(&executor);
  (void)rcl_node_fini(&node);
  (void)rclc_support_fini(&support);
}

/* Why a call failed: the library keeps the text of the last error. */
static void report(const char * what)
{
  (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
  rcl_reset_error();
}

/* Lets the client work for a while, then looks at the clock: it stands at 0 until the first time has come. */
static uint32_t look_at_the_clock(void)
{
  int64_t now_ns = 0;

  if (
    rclc_executor_spin_some(&executor, RCL_MS_TO_NS(EXAMPLE_PERIOD_MS)) != RCL_RET_OK ||
    rcl_clock_get_now(&support.clock, &now_ns) != RCL_RET_OK) {
    report("clock");
    return 1;
  }
  (void)printf("%lld.%09lld s\n", (long long)(now_ns / 1000000000), (long long)(now_ns % 1000000000));
  (void)fflush(stdout);
  return 0;
}

int main(void)
{
  uint32_t failed = 0;

  if (application_init() != RCL_RET_OK) {
    report("start");
    application_fini();
    return 1;
  }
  for (uint32_t count = 0; count < EXAMPLE_SAMPLES; ++count) {
    failed += look_at_the_clock();
  }
  application_fini();
  return failed == 0 ? 0 : 1;
}
