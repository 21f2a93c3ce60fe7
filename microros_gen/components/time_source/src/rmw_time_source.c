/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/time_source.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/xrce_client.h"
#include "microros_config.h"

#include <stddef.h>

static const int64_t source_ns_per_ms = 1000000;
static const int64_t source_widest_ns = 1000000000;
static const int64_t source_latest_ns = INT64_MAX / 2;

/* Returns the name of the argument that cannot be; NULL: they all can. */
static const char * source_fault(
  const xrce_time_filter_t * filter, const xrce_time_sample_t * sample, int64_t now_ns)
{
  if ((sample->local_ns > now_ns) || (filter->is_set && (sample->local_ns <= filter->local_ns))) {
    return "local_ns";
  }
  if ((sample->reference_ns < 0) || (sample->reference_ns > source_latest_ns)) {
    return "reference_ns";
  }
  return ((sample->uncertainty_ns < 0) || (sample->uncertainty_ns > source_widest_ns)) ? "uncertainty_ns"
                                                                                       : NULL;
}

static rmw_ret_t source_sample(const xrce_time_sample_t * sample)
{
  xrce_client_t * client = rmw_client_instance();
  const int64_t now_ns = port_time_steady_ns();
  const char * fault;

  if (client->session.state == (uint8_t)XRCE_CLOSED) {
    return microros_error_refuse(RMW_RET_ERROR, "session");
  }
  fault = source_fault(&client->time_source.filter, sample, now_ns);
  if (fault != NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, fault);
  }
  if (!xrce_time_source_take(client, sample, now_ns)) {
    return microros_error_named(RMW_RET_ERROR, microros_error_time_source, "the sample is an outlier");
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_uros_time_source_sample(int64_t local_ns, int64_t reference_ns, int64_t uncertainty_ns)
{
  const xrce_time_sample_t sample = {local_ns, reference_ns, uncertainty_ns};
  rmw_ret_t result;

  microros_lock();
  result = source_sample(&sample);
  microros_unlock();
  return result;
}

int64_t rmw_uros_time_source_local(void)
{
  return port_time_steady_ns();
}

static rmw_uros_time_state_t source_state(bool is_known, int64_t age_ns)
{
  if (!is_known) {
    return RMW_UROS_TIME_UNSET;
  }
  return (age_ns > ((int64_t)MICROROS_TIME_HOLDOVER_MS * source_ns_per_ms)) ? RMW_UROS_TIME_HOLDOVER
                                                                            : RMW_UROS_TIME_FOLLOWING;
}

static void source_read(rmw_uros_time_status_t * status)
{
  const xrce_client_t * client = rmw_client_instance();
  const xrce_time_filter_t * filter = &client->time_source.filter;
  const int64_t now_ns = port_time_steady_ns();
  const bool is_known = (client->session.state != (uint8_t)XRCE_CLOSED) && filter->is_set;

  status->age_ns = is_known ? (now_ns - filter->local_ns) : 0;
  status->state = source_state(is_known, status->age_ns);
  status->offset_ns =
    is_known ? (xrce_time_filter_estimate(filter, now_ns) - xrce_time_served(filter, now_ns)) : 0;
  status->uncertainty_ns = is_known ? xrce_time_filter_uncertainty(filter, now_ns) : 0;
  status->drift_ppb = filter->drift_ppb;
  status->accepted = filter->accepted;
  status->rejected = filter->rejected;
  status->steps = filter->steps;
}

rmw_ret_t rmw_uros_time_source_status(rmw_uros_time_status_t * status)
{
  if (status == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "status");
  }
  microros_lock();
  source_read(status);
  microros_unlock();
  return RMW_RET_OK;
}
