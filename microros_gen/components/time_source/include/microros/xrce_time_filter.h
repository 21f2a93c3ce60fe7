/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The time of a source, estimated from samples that are late, early, or wrong: offset and drift of the device's steady
 * clock by a Kalman filter of two states in integers, and the time that is served, which approaches the estimate.
 * Internal. Nothing here waits, locks, or reads a clock: `local` times are those of port_time_steady_ns.
 */
#ifndef MICROROS_XRCE_TIME_FILTER_H
#define MICROROS_XRCE_TIME_FILTER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct xrce_time_sample_t {
  int64_t local_ns;
  int64_t reference_ns;   /* what the source said at local_ns */
  int64_t uncertainty_ns; /* one standard deviation */
} xrce_time_sample_t;

/* Covariance of the estimate. Its limits keep every product below 2^63: see xrce_time_filter.c. */
typedef struct xrce_time_variance_t {
  int64_t offset; /* us^2 */
  int64_t both;   /* us * ppb */
  int64_t drift;  /* ppb^2 */
} xrce_time_variance_t;

/* Zero-initialized: the time is not known yet. */
typedef struct xrce_time_filter_t {
  int64_t local_ns;     /* of the newest accepted sample */
  int64_t reference_ns; /* estimate for that moment */
  xrce_time_variance_t variance;
  int64_t anchor_local_ns; /* since when the time is served as follows */
  int64_t anchor_ns;       /* the time that was served then */
  int64_t pending_ns;      /* what the estimate was ahead of it */
  uint32_t accepted;       /* counts, which wrap */
  uint32_t rejected;
  uint32_t steps;
  int32_t
    drift_ppb; /* the source's seconds are longer (negative) or shorter than the device's; kept over a sleep */
  uint8_t outliers; /* rejected one after another */
  bool is_set;
} xrce_time_filter_t;

/*
 * Takes a sample, at the moment `now_ns`. False: it is an outlier, which changes nothing and is counted. Several outliers one
 * after another are a source that has changed: the last of them is then taken. The first sample sets the time, unless
 * xrce_time_served already has one (`is_set`). */
bool xrce_time_filter_sample(xrce_time_filter_t * filter, const xrce_time_sample_t * sample, int64_t now_ns);

/* Returns the estimate of the source's time. */
int64_t xrce_time_filter_estimate(const xrce_time_filter_t * filter, int64_t now_ns);

/* Returns the standard deviation of the estimate, nanoseconds: it grows with the age of the newest sample. */
int64_t xrce_time_filter_uncertainty(const xrce_time_filter_t * filter, int64_t now_ns);

/* Returns the time that is served: it never goes back between two calls without a step. */
int64_t xrce_time_served(const xrce_time_filter_t * filter, int64_t now_ns);

/* Lets what is served approach the estimate, from `served_ns` at the moment `now_ns` on; from a declared error on it is
 * set. */
void xrce_time_serve(xrce_time_filter_t * filter, int64_t served_ns, int64_t now_ns);

/* Returns value * factor / divisor, rounded toward zero, for results and value % divisor * factor below 2^63. */
static inline int64_t xrce_time_scaled(int64_t value, int64_t factor, int64_t divisor)
{
  return ((value / divisor) * factor) + (((value % divisor) * factor) / divisor);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_TIME_FILTER_H */
