/* SPDX-License-Identifier: Apache-2.0 */
/* The reliable stream over a line that does not copy its messages: a slot that has another message is not sent any more. One
 * slot. The unit takes bytes as the interrupt of a UART does. */
#include "unit.h"

#include "port_bare_serial.c"

#include "microros/xrce_client.h"
#include "microros/xrce_wire.h"

#include <string.h>

enum {
  FILL = MICROROS_RELIABLE_SLOT_SIZE - XRCE_MESSAGE_HEADER,
  MOST = 2 * (MICROROS_RELIABLE_SLOT_SIZE + 7)
};

static xrce_session_t session;
static xrce_stream_reliable_t stream;

void port_uart_start(void)
{
}

void port_uart_stop(void)
{
}

void port_uart_send(void)
{
}

static void write_one(uint8_t byte)
{
  uint8_t * room = xrce_stream_reliable_reserve(&stream, &session);

  CHECK(room != NULL);
  memset(room, byte, FILL);
  xrce_stream_reliable_commit(&stream, &session, FILL, 0);
}

static void acknowledge(uint16_t expected)
{
  uint8_t payload[5] = {0};

  xrce_put_le16(&payload[0], expected);
  payload[4] = XRCE_STREAM_RELIABLE;
  CHECK(xrce_stream_reliable_on_acknack(&stream, &session, payload, 5, XRCE_FLAG_LITTLE_ENDIAN, 0));
}

/* Takes the waiting bytes, and looks whether it is one frame of a message with `byte`, numbered `sequence`. */
static void check_frame(uint8_t byte, uint16_t sequence)
{
  uint8_t raw[MOST];
  uint8_t frame[MOST];
  size_t size = 0;
  size_t plain = 0;
  uint16_t crc = 0;

  while (port_uart_next(&raw[size])) {
    ++size;
    CHECK(size < MOST);
  }
  CHECK(size != 0u && raw[0] == 0x7e);
  for (size_t i = 1; i < size; ++i) {
    const bool escaped = raw[i] == 0x7d;

    CHECK(raw[i] != 0x7e);
    i += escaped ? 1u : 0u;
    frame[plain++] = escaped ? raw[i] ^ 0x20 : raw[i];
  }
  CHECK(plain == MICROROS_RELIABLE_SLOT_SIZE + 6u && xrce_get_le16(&frame[2]) == MICROROS_RELIABLE_SLOT_SIZE);
  for (size_t i = 4; i < plain; ++i) {
    crc = xrce_framing_crc(crc, frame[i]);
  }
  CHECK(crc == 0u && xrce_get_le16(&frame[6]) == sequence);
  for (size_t i = 8; i < plain - 2u; ++i) {
    CHECK(frame[i] == byte);
  }
}

/* An acknowledgement comes while the message is on its way a second time. */
static void test_a_slot_that_has_another_message_is_broken_off(void)
{
  uint8_t byte = 0;

  write_one(0x7e);
  CHECK(port_output.put == 0u); /* nothing was copied */
  check_frame(0x7e, 0);
  acknowledge(0);
  stream.unsent = 1;
  xrce_stream_reliable_step(&stream, &session, true, 0);
  for (uint32_t i = 0; i < 20u; ++i) {
    CHECK(port_uart_next(&byte));
  }
  acknowledge(1);
  write_one(0x55);
  check_frame(0x55, 1);
}

/* What was sent is kept until it is acknowledged; what is to be sent again waits for the line. */
static void test_one_message_at_a_time(void)
{
  const uint32_t sent = session.statistics.sent;

  stream.unsent = 1;
  xrce_stream_reliable_step(&stream, &session, true, 0);
  CHECK(session.statistics.sent == sent + 1u && stream.unsent == 0u);
  stream.unsent = 1;
  xrce_stream_reliable_step(&stream, &session, true, 0);
  CHECK(session.statistics.sent == sent + 1u && xrce_stream_reliable_is_blocked(&stream));
  check_frame(0x55, 1);
  xrce_stream_reliable_step(&stream, &session, true, 0);
  CHECK(session.statistics.sent == sent + 2u);
  xrce_transport_close(&session.transport);
  CHECK(port_serial_is_idle(&session.transport.serial));
}

int main(void)
{
  session.state = XRCE_READY;
  session.transport_open = true;
  test_a_slot_that_has_another_message_is_broken_off();
  test_one_message_at_a_time();
  return 0;
}
