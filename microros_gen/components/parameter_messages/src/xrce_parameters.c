/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_parameters.h"

#include "microros/xrce_client.h"
#include "microros/xrce_read.h"

/* Start of DATA: the submessage's header, request id and object id. */
enum { PARAMETERS_LENGTH_AT = 2, PARAMETERS_REQUEST_AT = 4, PARAMETERS_OBJECT_AT = 6, SAMPLE_AT = 8 };

void xrce_parameters_keep_beginning(const xrce_endpoint_t * endpoint, uint8_t size)
{
  endpoint->client->beginnings[endpoint->index - MICROROS_PUBLISHERS_MAX] = size;
}

/* Keeps the first bytes of a DATA that is too large: `here` of its `whole` bytes have arrived after its header. */
static void parameters_keep(
  xrce_client_t * client, const uint8_t * data, size_t here, size_t whole, uint32_t now)
{
  xrce_receiver_t * receiver;
  xrce_sample_t sample;
  uint8_t size;

  if (here < XRCE_OBJECT_PREFIX + (size_t)XRCE_PARAMETERS_BEGINNING || (data[1] & XRCE_READ_FORMATS) != 0u) {
    return;
  }
  receiver = xrce_read_requested(
    client, xrce_get_be16(&data[PARAMETERS_REQUEST_AT]), xrce_get_be16(&data[PARAMETERS_OBJECT_AT]));
  size = receiver != NULL ? client->beginnings[receiver - client->receivers] : 0u;
  if (size == 0u || whole <= (size_t)xrce_read_largest(client, receiver) + XRCE_OBJECT_PREFIX) {
    return;
  }
  sample.data = &data[SAMPLE_AT];
  sample.arrived_ms = now;
  sample.size = size;
  sample.big_endian = (data[1] & XRCE_FLAG_LITTLE_ENDIAN) == 0u;
  xrce_read_keep(client, receiver, &sample, true);
}

void xrce_parameters_on_data(xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  parameters_keep(client, submessage, size, size, now);
}

void xrce_parameters_on_fragment(
  xrce_client_t * client, const uint8_t * submessage, size_t size, uint32_t now)
{
  const uint8_t * data = xrce_payload_of(submessage);

  if (!client->large_begun && size > XRCE_SUBMESSAGE_HEADER && data[0] == XRCE_DATA) {
    parameters_keep(
      client, data, size - XRCE_SUBMESSAGE_HEADER, xrce_get_le16(&data[PARAMETERS_LENGTH_AT]), now);
  }
  client->large_begun = (xrce_flags_of(submessage) & XRCE_FLAG_LAST_FRAGMENT) == 0u;
}

void xrce_parameters_renew(xrce_client_t * client)
{
  client->large_begun = false;
}
