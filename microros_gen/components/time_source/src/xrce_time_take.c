/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_client.h"
#include "microros/xrce_time_source.h"

bool xrce_time_source_take(xrce_client_t * client, const xrce_time_sample_t * sample, int64_t now_ns)
{
  xrce_time_filter_t * filter = &client->time_source.filter;

  if (!filter->is_set && client->time_sync.synchronized) {
    filter->anchor_local_ns = now_ns; /* the time that was served so far is where it goes on from */
    filter->anchor_ns = now_ns + client->time_sync.offset_ns;
    filter->pending_ns = 0;
    filter->is_set = true;
  }
  return xrce_time_filter_sample(filter, sample, now_ns);
}
