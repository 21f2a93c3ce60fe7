/* SPDX-License-Identifier: Apache-2.0 */
/* State of a receiver other than its waiting samples. */
#include "microros/xrce_client.h"
#include "microros/xrce_loan.h"
#include "microros/xrce_read.h"

static xrce_receiver_t * state_of(const xrce_endpoint_t * endpoint)
{
  return &endpoint->client->receivers[endpoint->index - MICROROS_PUBLISHERS_MAX];
}

void xrce_read_open(const xrce_endpoint_t * endpoint)
{
  xrce_receiver_t * receiver = state_of(endpoint);

  xrce_receiver_clear(receiver);
  xrce_loan_clear(endpoint->client, receiver);
}

void xrce_read_drop(xrce_client_t * client, xrce_receiver_t * receiver)
{
  ++receiver->dropped;
  ++client->session.statistics.dropped;
}

bool xrce_read_is_ready(const xrce_endpoint_t * endpoint)
{
  const xrce_receiver_t * receiver = state_of(endpoint);

  return (receiver->count != 0u && !xrce_loan_is_out(endpoint->client, receiver)) || receiver->large != 0u ||
         receiver->status != 0u;
}

uint16_t xrce_read_large(const xrce_endpoint_t * endpoint, uint16_t * fits)
{
  xrce_receiver_t * receiver = state_of(endpoint);
  const uint16_t large = receiver->large;

  *fits = xrce_read_largest(endpoint->client, receiver);
  receiver->large = 0;
  return large;
}

uint8_t xrce_read_status(const xrce_endpoint_t * endpoint)
{
  xrce_receiver_t * receiver = state_of(endpoint);
  const uint8_t status = receiver->status;

  receiver->status = 0;
  return status;
}

xrce_read_counters_t xrce_read_counters(const xrce_endpoint_t * endpoint)
{
  const xrce_receiver_t * receiver = state_of(endpoint);
  const xrce_read_counters_t counters = {receiver->dropped, receiver->refused};

  return counters;
}
