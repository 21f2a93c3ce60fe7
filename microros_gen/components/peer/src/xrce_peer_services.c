/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_peer_services.h"

#include "microros/xrce_client.h"
#include "microros/xrce_read.h"
#include "microros/xrce_wire.h"

bool xrce_peer_services_read(xrce_peer_data_t * data, uint8_t * input, size_t at)
{
  const uint8_t * submessage = &input[MICROROS_PEER_HEAD + at];
  const uint8_t * payload = xrce_payload_of(submessage);
  const size_t size = xrce_get_le16(&submessage[2]);

  data->input = input;
  data->flags = xrce_flags_of(submessage);
  if (size <= XRCE_OBJECT_PREFIX || (data->flags & XRCE_READ_FORMATS) != 0u) {
    return false;
  }
  data->at = MICROROS_PEER_HEAD + at + (size_t)XRCE_WRITE_PREFIX;
  data->size = size - (size_t)XRCE_OBJECT_PREFIX;
  data->request = xrce_get_be16(&payload[0]);
  data->object = xrce_get_be16(&payload[2]);
  return true;
}

void xrce_peer_services_keep(
  xrce_client_t * client, uint16_t receiver, const xrce_peer_data_t * data, uint32_t now)
{
  xrce_receiver_t * keeper = &client->receivers[receiver];
  const xrce_sample_t sample = {
    .data = &data->input[data->at],
    .arrived_ms = now,
    .size = (uint16_t)data->size,
    .big_endian = (data->flags & XRCE_FLAG_LITTLE_ENDIAN) == 0u};

  if (!client->states[XRCE_READERS_AT + receiver].wanted) {
    ++client->session.statistics.dropped;
  } else if (sample.size > xrce_read_largest(client, keeper)) {
    keeper->large = sample.size;
    ++keeper->refused;
    ++client->session.statistics.dropped;
  } else {
    xrce_read_keep(client, keeper, &sample, true);
  }
}

bool xrce_peer_services_is_key(const uint8_t * guid, uint32_t key)
{
  return xrce_get_be16(&guid[XRCE_PEER_KEY_AT]) == key >> 16 &&
         xrce_get_be16(&guid[XRCE_PEER_KEY_AT + 2]) == (key & UINT16_MAX);
}
