/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_new_data.h"

#include "microros/xrce_arrivals.h"

#include <stddef.h>

/* `before`: samples before the current message of the agent. */
typedef struct new_data_t {
  rmw_event_callback_t callback; /* NULL: none */
  const void * user_data;
  uint32_t before;
} new_data_t;

/* Outside of the client: a saved session restores no pointers of the application. */
static new_data_t new_data[XRCE_RECEIVERS];

void xrce_new_data_set(
  const xrce_endpoint_t * endpoint, rmw_event_callback_t callback, const void * user_data)
{
  const uint16_t index = (uint16_t)(endpoint->index - MICROROS_PUBLISHERS_MAX);
  const uint8_t waiting = endpoint->client->receivers[index].count;

  new_data[index].callback = callback;
  new_data[index].user_data = user_data;
  if (callback != NULL && waiting != 0u) {
    callback(user_data, waiting);
  }
}

void xrce_new_data_clear(const xrce_endpoint_t * endpoint)
{
  xrce_new_data_set(endpoint, NULL, NULL);
}

void xrce_new_data_before(const xrce_client_t * client)
{
  for (uint16_t i = 0; i < (uint16_t)XRCE_RECEIVERS; ++i) {
    new_data[i].before = xrce_arrivals(client, i);
  }
}

void xrce_new_data_after(const xrce_client_t * client)
{
  for (uint16_t i = 0; i < (uint16_t)XRCE_RECEIVERS; ++i) {
    const uint32_t arrived = xrce_arrivals(client, i) - new_data[i].before;

    if (arrived != 0u && new_data[i].callback != NULL) {
      new_data[i].callback(new_data[i].user_data, (size_t)arrived);
    }
  }
}
