/* SPDX-License-Identifier: Apache-2.0 */
/* The time that is served: a line with the learned drift, steeper or flatter until it meets the estimate. */
#include "microros/xrce_time_filter.h"

#include "microros_config.h"

static const int64_t served_ns_per_us = 1000;
static const int64_t served_ppb = 1000000000;
static const int64_t served_slew_ppb = (int64_t)MICROROS_TIME_SLEW_PPM * 1000;

/* The limit of the correction is a separate rate, rounded once with the drift: two roundings could add up to a
 * nanosecond backward. */
int64_t xrce_time_served(const xrce_time_filter_t * filter, int64_t now_ns)
{
  const int64_t passed = now_ns - filter->anchor_local_ns;
  const int64_t whole = passed + xrce_time_scaled(passed, filter->drift_ppb, served_ppb) + filter->pending_ns;
  const int64_t rate = filter->drift_ppb + ((filter->pending_ns < 0) ? -served_slew_ppb : served_slew_ppb);
  const int64_t slewed = passed + xrce_time_scaled(passed, rate, served_ppb);
  const bool is_over = (filter->pending_ns < 0) ? (slewed <= whole) : (slewed >= whole);

  return filter->anchor_ns + (is_over ? whole : slewed);
}

void xrce_time_serve(xrce_time_filter_t * filter, int64_t served_ns, int64_t now_ns)
{
  const int64_t step_ns = (int64_t)MICROROS_TIME_STEP_US * served_ns_per_us;
  const int64_t pending_ns = xrce_time_filter_estimate(filter, now_ns) - served_ns;
  const int64_t size_ns = (pending_ns < 0) ? -pending_ns : pending_ns;

  filter->anchor_local_ns = now_ns;
  filter->anchor_ns = served_ns;
  filter->pending_ns = pending_ns;
  if (size_ns >= step_ns) {
    filter->anchor_ns += pending_ns;
    filter->pending_ns = 0;
    ++filter->steps;
  }
}
