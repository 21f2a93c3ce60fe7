/* SPDX-License-Identifier: Apache-2.0 */
/* The network goes down under a connection and comes back: only where the application can do that. */
#include "selftest_checks.h"
#include "selftest_report.h"

#ifdef SELFTEST_LINK

#include "microros/port.h"
#include "selftest.h"
#include "selftest_link.h"

enum { ZERO_MS = 10, PATIENCE_MS = 200, MESSAGES = 16, BYTES = 64 };

/* GET_INFO outside of a session after its length (OMG DDS-XRCE 1.0, 8.3.5.3 and 11.3), which every agent answers. */
static const uint8_t question[] = {
  16, 0, 0x80, 0, 0, 0, 0x02, 0x01, 8, 0, 0, 0x0a, 0xff, 0xfd, 0x02, 0, 0, 0};

static port_tcp_t tcp;
static bool is_open;
static uint8_t received[BYTES];

static void send(void)
{
  (void)port_tcp_send(&tcp, question, sizeof(question)); /* without a network it may be taken or refused */
}

static void receive(void)
{
  (void)port_tcp_receive(&tcp, received, sizeof(received));
}

static void close_connection(void)
{
  if (is_open) {
    port_tcp_close(&tcp);
  }
  is_open = false;
}

/* Connects again: the connection may have gone with the link. */
static bool open_connection(void)
{
  close_connection();
  is_open = port_tcp_open(&tcp, SELFTEST_HOST, (uint16_t)SELFTEST_PORT);
  return is_open;
}

/* Returns whether the agent answers a question. */
static bool is_answered(void)
{
  const uint32_t start_ms = port_time_ms();
  size_t sent = 0;
  bool is_answer = false;
  bool is_fine = is_open;

  while (is_fine && !is_answer && port_time_ms() - start_ms < (uint32_t)PATIENCE_MS) {
    const int32_t taken =
      sent < sizeof(question) ? port_tcp_send(&tcp, &question[sent], sizeof(question) - sent) : 0;

    is_fine = taken >= 0;
    sent += is_fine ? (size_t)taken : 0u;
    is_answer = port_tcp_receive(&tcp, received, sizeof(received)) > 0;
    port_sleep_ms(1);
  }
  return is_answer;
}

static void check_down(void)
{
  int32_t size;

  if (!is_open) {
    return;
  }
  selftest_at_most(
    "tcp_link_down_send_never_waits", (int64_t)selftest_shortest_ms(send), (int64_t)ZERO_MS, "ms");
  size = port_tcp_receive(&tcp, received, sizeof(received));
  selftest_at_most("tcp_link_down_receive_nothing", (int64_t)size, 0, "bytes"); /* -1: it is closed */
  selftest_at_most(
    "tcp_link_down_receive_never_waits", (int64_t)selftest_shortest_ms(receive), (int64_t)ZERO_MS, "ms");
}

static void check_up(bool was_answered)
{
  const selftest_link_t link = selftest_link_again(open_connection, is_answered, was_answered);

  selftest_true("tcp_link_up_opens", link.opens, "no connection", "one within 2 s after the link is up");
  if (was_answered) {
    selftest_true(
      "tcp_link_up_answers", link.is_answered, "no answer of the agent", "one, as before the link was down");
  } else {
    selftest_skip("tcp_link_up_answers", "no agent at " SELFTEST_HOST " answers while the link is up");
  }
}

void selftest_tcp_link(void)
{
  const bool was_answered = open_connection() && is_answered();

  selftest_set_link(false);
  for (uint8_t i = 0; i < (uint8_t)MESSAGES && is_open; ++i) {
    receive(); /* what had arrived before */
  }
  check_down();
  selftest_set_link(true);
  check_up(was_answered);
  close_connection();
}

#else

void selftest_tcp_link(void)
{
  selftest_skip(
    "tcp_link_down", "define selftest_set_link, and -DSELFTEST_LINK when you compile the self-test");
}

#endif
