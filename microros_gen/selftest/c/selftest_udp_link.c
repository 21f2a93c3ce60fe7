/* SPDX-License-Identifier: Apache-2.0 */
/* The network goes down and comes back: only where the application can do that, as it disturbs everything else. */
#include "selftest_checks.h"
#include "selftest_report.h"

#ifdef SELFTEST_LINK

#include "microros/port.h"
#include "selftest.h"
#include "selftest_link.h"

enum { ZERO_MS = 10, PATIENCE_MS = 200, MESSAGES = 16, BYTES = 64 };

/* GET_INFO outside of a session (OMG DDS-XRCE 1.0, 8.3.5.3), which every agent answers. */
static const uint8_t question[] = {0x80, 0, 0, 0, 0x02, 0x01, 8, 0, 0, 0x0a, 0xff, 0xfd, 0x02, 0, 0, 0};

static port_udp_t udp;
static bool is_open;
static uint8_t received[BYTES];

static void send(void)
{
  (void)port_udp_send(&udp, question, sizeof(question)); /* without a network it may be taken or refused */
}

static void receive(void)
{
  (void)port_udp_receive(&udp, received, sizeof(received));
}

static void close_socket(void)
{
  if (is_open) {
    port_udp_close(&udp);
  }
  is_open = false;
}

/* Opens the socket again: its network may have gone with the link. */
static bool open_socket(void)
{
  close_socket();
  is_open = port_udp_open(&udp, SELFTEST_HOST, (uint16_t)SELFTEST_PORT);
  return is_open;
}

/* Returns whether the agent answers a question. */
static bool is_answered(void)
{
  const uint32_t start_ms = port_time_ms();
  bool is_answer = false;

  if (is_open && port_udp_send(&udp, question, sizeof(question))) {
    while (!is_answer && port_time_ms() - start_ms < (uint32_t)PATIENCE_MS) {
      is_answer = port_udp_receive(&udp, received, sizeof(received)) > 0;
      port_sleep_ms(1);
    }
  }
  return is_answer;
}

static void check_down(void)
{
  if (!is_open) {
    return;
  }
  selftest_at_most("link_down_send_never_waits", (int64_t)selftest_shortest_ms(send), (int64_t)ZERO_MS, "ms");
  selftest_equal(
    "link_down_receive_nothing", (int64_t)port_udp_receive(&udp, received, sizeof(received)), 0, "bytes");
  selftest_at_most(
    "link_down_receive_never_waits", (int64_t)selftest_shortest_ms(receive), (int64_t)ZERO_MS, "ms");
}

static void check_up(bool was_answered)
{
  const selftest_link_t link = selftest_link_again(open_socket, is_answered, was_answered);

  selftest_true("link_up_opens", link.opens, "no socket", "one within 2 s after the link is up");
  if (was_answered) {
    selftest_true(
      "link_up_answers", link.is_answered, "no answer of the agent", "one, as before the link was down");
  } else {
    selftest_skip("link_up_answers", "no agent at " SELFTEST_HOST " answers while the link is up");
  }
}

void selftest_udp_link(void)
{
  const bool was_answered = open_socket() && is_answered();

  selftest_set_link(false);
  for (uint8_t i = 0; i < (uint8_t)MESSAGES && is_open; ++i) {
    receive(); /* what had arrived before */
  }
  check_down();
  selftest_set_link(true);
  check_up(was_answered);
  close_socket();
}

#else

void selftest_udp_link(void)
{
  selftest_skip("link_down", "define selftest_set_link, and -DSELFTEST_LINK when you compile the self-test");
}

#endif
