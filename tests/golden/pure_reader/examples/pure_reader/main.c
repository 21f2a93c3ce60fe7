/*
 * An application for pure_reader, to start from: copy it out of this folder and change it.
 * It publishes nothing every EXAMPLE_PERIOD_MS milliseconds.
 */
#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/rclc.h>

#include <stdint.h>
#include <stdio.h>

#ifndef EXAMPLE_PERIOD_MS
#define EXAMPLE_PERIOD_MS 100
#endif

/* How often it publishes before it ends: here, for years. */
#ifndef EXAMPLE_SAMPLES
#define EXAMPLE_SAMPLES UINT32_MAX
#endif

static rclc_support_t support;
static rcl_node_t node;

static rcl_ret_t application_init(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "pure_reader", "", &support);
  }
  return result;
}

static void application_fini(void)
{
  (void)rcl_node_fini(&node);
  (void)rclc_support_fini(&support);
}

/* Why a call failed: the library keeps the text of the last error. */
static void report(const char * what)
{
  (void)fprintf(stderr, "%s: %s\n", what, rcl_get_error_string().str);
  rcl_reset_error();
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
    rclc_sleep_ms(EXAMPLE_PERIOD_MS);
  }
  application_fini();
  return failed == 0 ? 0 : 1;
}
