/* SPDX-License-Identifier: Apache-2.0 */
/* The bus is taken from the controller and comes back: only where the application can do that. */
#include "selftest_checks.h"
#include "selftest_report.h"

#ifdef SELFTEST_LINK

#include "microros/port.h"
#include "microros/port_can.h"
#include "microros_config.h"
#include "selftest.h"
#include "selftest_link.h"

enum { ZERO_MS = 10, PATIENCE_MS = 200, FRAMES = 64, SIZE = 8 };

static port_can_t can;
static bool is_open;
static uint8_t sent[PORT_CAN_DATA];
static uint8_t received[PORT_CAN_DATA];

static void send(void)
{
  (void)port_can_send(&can, sent, SIZE); /* without a bus it may be taken or refused */
}

static void receive(void)
{
  (void)port_can_receive(&can, received);
}

static void close_controller(void)
{
  if (is_open) {
    port_can_close(&can);
  }
  is_open = false;
}

/* Opens the controller again: a device under Linux may have gone with the bus. */
static bool open_controller(void)
{
  close_controller();
  is_open = port_can_open(&can, MICROROS_CAN_DEVICE, (uint32_t)MICROROS_CAN_ID);
  return is_open;
}

/* Returns whether a frame comes back: the controller may be in loopback mode. */
static bool is_looped(void)
{
  const uint32_t start_ms = port_time_ms();
  bool has_returned = false;

  if (is_open && port_can_send(&can, sent, SIZE)) {
    while (!has_returned && port_time_ms() - start_ms < (uint32_t)PATIENCE_MS) {
      has_returned = port_can_receive(&can, received) == (size_t)SIZE;
      port_sleep_ms(1);
    }
  }
  return has_returned;
}

static void check_down(void)
{
  if (!is_open) {
    return;
  }
  selftest_equal("canfd_link_down_receive_nothing", (int64_t)port_can_receive(&can, received), 0, "bytes");
  selftest_at_most(
    "canfd_link_down_receive_never_waits", (int64_t)selftest_shortest_ms(receive), (int64_t)ZERO_MS, "ms");
  selftest_at_most(
    "canfd_link_down_send_never_waits", (int64_t)selftest_shortest_ms(send), (int64_t)ZERO_MS, "ms");
}

static void check_up(bool was_looped)
{
  const selftest_link_t link = selftest_link_again(open_controller, is_looped, was_looped);

  selftest_true("canfd_link_up_opens", link.opens, "no controller", "one within 2 s after the bus is back");
  if (was_looped) {
    selftest_true(
      "canfd_link_up_returns", link.is_answered, "nothing that came back",
      "a frame, as before the bus was taken");
  } else {
    selftest_skip(
      "canfd_link_up_returns",
      "nothing came back while the bus was there: put the controller into loopback mode");
  }
}

void selftest_canfd_link(void)
{
  const bool was_looped = open_controller() && is_looped();

  selftest_set_link(false);
  for (uint8_t i = 0; i < (uint8_t)FRAMES && is_open; ++i) {
    receive(); /* what had arrived before */
  }
  check_down();
  selftest_set_link(true);
  check_up(was_looped);
  close_controller();
}

#else

void selftest_canfd_link(void)
{
  selftest_skip(
    "canfd_link_down", "define selftest_set_link, and -DSELFTEST_LINK when you compile the self-test");
}

#endif
