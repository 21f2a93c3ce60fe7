/* SPDX-License-Identifier: Apache-2.0 */
/* A best-effort sample waits at the end of the input buffer while a message arrives in parts, as in plans with tasks. */
#include "unit.h"

#include "microros/port.h"
#include "microros/xrce_client.h"
#include "microros/xrce_read.h"
#include "microros/xrce_turn_bytes.h"

static xrce_client_t client;

bool port_tcp_open(port_tcp_t * tcp, const char * host, uint16_t port)
{
  (void)tcp;
  (void)host;
  (void)port;
  return false;
}

void port_tcp_close(port_tcp_t * tcp)
{
  (void)tcp;
}

int32_t port_tcp_send(port_tcp_t * tcp, const uint8_t * data, size_t size)
{
  (void)tcp;
  (void)data;
  (void)size;
  return -1;
}

int32_t port_tcp_receive(port_tcp_t * tcp, uint8_t * buffer, size_t capacity)
{
  (void)tcp;
  (void)buffer;
  (void)capacity;
  return -1;
}

/* Returns whether the sample is still there after a receive call, and so many bytes of a message that is not complete. */
static bool keeps_sample(int32_t received, uint32_t arrived)
{
  xrce_receiver_t * receiver = &client.receivers[MICROROS_INPUT_READER];

  receiver->count = 1;
  client.session.transport.length_arrived = (uint8_t)XRCE_TCP_PREFIX;
  client.session.transport.arrived = (uint16_t)arrived;
  xrce_read_on_input(&client, received);
  return receiver->count == 1u;
}

int main(void)
{
  CHECK(xrce_turn_is_partial(XRCE_TURN_PARTIAL));
  CHECK(keeps_sample(XRCE_TURN_PARTIAL, MICROROS_INPUT_FREE));
  CHECK(!keeps_sample(XRCE_TURN_PARTIAL, MICROROS_INPUT_FREE + 1u));
  CHECK(keeps_sample(0, MICROROS_INPUT_FREE));
  CHECK(!keeps_sample(0, MICROROS_INPUT_FREE + 1u));
  CHECK(keeps_sample((int32_t)MICROROS_INPUT_FREE, 0));
  CHECK(!keeps_sample((int32_t)MICROROS_INPUT_FREE + 1, 0));
  CHECK(!keeps_sample(-1, 0)); /* a discarded message */
  CHECK(client.session.statistics.dropped == 4u);
  return 0;
}
