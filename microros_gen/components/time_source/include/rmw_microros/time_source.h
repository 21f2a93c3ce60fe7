/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The time of day from a source: the agent, which the library asks once in `time_source: {period}`, or with
 * `source: application` an NTP or PTP client or a GPS receiver of the application. rmw_uros_epoch_* and clocks of the type
 * RCL_SYSTEM_TIME then give the time of that source.
 */
#ifndef MICROROS_RMW_MICROROS_TIME_SOURCE_H
#define MICROROS_RMW_MICROROS_TIME_SOURCE_H

#include <stdint.h>

#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum rmw_uros_time_state_t {
  RMW_UROS_TIME_UNSET = 0, /* no sample since rcl_init or a sleep */
  RMW_UROS_TIME_FOLLOWING = 1,
  RMW_UROS_TIME_HOLDOVER =
    2, /* the newest sample is older than `holdover`; the time continues with the learned drift */
} rmw_uros_time_state_t;

typedef struct rmw_uros_time_status_t {
  rmw_uros_time_state_t state;
  int64_t offset_ns;      /* how far the source's time, as estimated, is ahead of the time that is served */
  int64_t uncertainty_ns; /* standard deviation of the estimate; grows without samples */
  int64_t age_ns;         /* of the newest sample that was taken */
  int32_t drift_ppb;      /* how much faster the source's clock is than the device's, 10^-9 */
  uint32_t accepted;      /* samples; these counts wrap */
  uint32_t rejected;      /* samples that were outliers */
  uint32_t steps;         /* how often the time was set because the error was `step` or more */
} rmw_uros_time_status_t;

/* Returns nanoseconds since the start of the device: the clock that samples of a source are compared with. */
int64_t rmw_uros_time_source_local(void);

/*
 * Takes a sample of a source: when the device's clock was `local_ns`, the source's was `reference_ns`, nanoseconds since 1970,
 * with a standard deviation of `uncertainty_ns`. For an exchange with a server that is half of the round trip at
 * most, for the pulse of a GPS receiver that of the interrupt. Does not wait; any task may call it, no interrupt.
 *   RMW_RET_OK                 taken
 *   RMW_RET_ERROR              an outlier, counted: the time goes on as before; eight one after another are no outliers. Or
 *                              there is no context
 *   RMW_RET_INVALID_ARGUMENT   local_ns is later than now, or not later than that of an earlier sample; reference_ns is before
 *                              1970 or after 2116; uncertainty_ns is negative or more than a second
 * All but RMW_RET_OK have a text.
 */
rmw_ret_t rmw_uros_time_source_sample(int64_t local_ns, int64_t reference_ns, int64_t uncertainty_ns);

/* Writes how well the source is followed. RMW_RET_INVALID_ARGUMENT, with a text: NULL. */
rmw_ret_t rmw_uros_time_source_status(rmw_uros_time_status_t * status);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_TIME_SOURCE_H */
