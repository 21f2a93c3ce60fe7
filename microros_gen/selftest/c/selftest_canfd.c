/* SPDX-License-Identifier: Apache-2.0 */
/* The controller may be in loopback mode: then each frame comes back, in each length of CAN FD. */
#include "microros/port.h"
#include "microros/port_can.h"
#include "microros_config.h"
#include "selftest_checks.h"
#include "selftest_lengths.h"
#include "selftest_report.h"

enum { ZERO_MS = 10, PATIENCE_MS = 200, SHORT = 8 };

static const uint8_t lengths[] = {1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, PORT_CAN_DATA};

static port_can_t can;
static uint8_t sent[PORT_CAN_DATA];
static uint8_t received[PORT_CAN_DATA];

static bool open_controller(void)
{
  return port_can_open(&can, MICROROS_CAN_DEVICE, (uint32_t)MICROROS_CAN_ID);
}

static void receive(void)
{
  (void)port_can_receive(&can, received);
}

static void send(void)
{
  (void)port_can_send(&can, sent, SHORT);
}

/* Returns the size of the next frame; 0 if none came back for too long. */
static size_t receive_back(void)
{
  const uint32_t start_ms = port_time_ms();
  size_t size = 0;

  while (size == 0u && port_time_ms() - start_ms < (uint32_t)PATIENCE_MS) {
    size = port_can_receive(&can, received);
    if (size == 0u) {
      port_sleep_ms(1);
    }
  }
  return size;
}

static bool comes_back(size_t size)
{
  selftest_fill(sent, size);
  return port_can_send(&can, sent, size) && receive_back() == size && selftest_is_filled(received, size);
}

static size_t wrong_length(void)
{
  for (size_t i = 0; i < sizeof(lengths); ++i) {
    if (!comes_back(lengths[i])) {
      return lengths[i];
    }
  }
  return 0;
}

static void check_loop(void)
{
  selftest_fill(sent, SHORT);
  selftest_true(
    "canfd_send", port_can_send(&can, sent, SHORT), "a frame that was refused", "one that was taken");
  if (receive_back() == 0u) {
    selftest_skip("canfd_lengths", "nothing came back: put the controller into loopback mode");
  } else {
    selftest_equal(
      "canfd_lengths", (int64_t)wrong_length(), 0, "as the first length that did not come back as sent");
  }
  selftest_at_most("canfd_send_never_waits", (int64_t)selftest_shortest_ms(send), (int64_t)ZERO_MS, "ms");
}

void selftest_canfd(void)
{
  if (!open_controller()) {
    selftest_true("canfd_open", false, "no controller", "the controller '" MICROROS_CAN_DEVICE "'");
    return;
  }
  selftest_true("canfd_open", true, "", "");
  selftest_equal("canfd_receive_nothing", (int64_t)port_can_receive(&can, received), 0, "bytes");
  selftest_at_most(
    "canfd_receive_never_waits", (int64_t)selftest_shortest_ms(receive), (int64_t)ZERO_MS, "ms");
  check_loop();
  port_can_close(&can);
  selftest_true("canfd_opens_again", open_controller(), "no controller", "a controller");
  port_can_close(&can);
}
