/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Limits, by which no product is 2^63 or more: the uncertainty of a sample is at most 1 s, the variance of the estimate below
 * 2^43 us^2, that of the drift below 2^38 ppb^2, so their covariance is below 2^41. A sum of variances is below 2^44, and
 * with 18 bits of fraction below 2^62.
 */
#include "microros/xrce_time_filter.h"

#include "microros_config.h"

enum { FILTER_OUTLIERS = 8 }; /* so many one after another are no outliers */
enum { FILTER_SIGMAS = 4 };   /* what is further away is an outlier */

static const int64_t filter_one = INT64_C(1) << 18; /* of fractions */
static const int64_t filter_ns_per_us = 1000;
static const int64_t filter_ns_per_ms = 1000000;
static const int64_t filter_ppb = 1000000000;
static const int64_t filter_us_per_ppb_ms = 1000000; /* a drift of 1 ppb is 1 us in so many milliseconds */
static const int64_t filter_longest_ms = 1000000000; /* after which the variances do not grow any more */
static const int64_t filter_most_offset = INT64_C(8000000000000);
static const int64_t filter_most_drift = INT64_C(250000000000); /* 500 ppm */
static const int64_t filter_first_drift = INT64_C(10000000000); /* crystals are within 100 ppm */
static const int64_t filter_least_drift = 4;
static const int64_t filter_wander = 100; /* ppb^2 in a second: what temperature changes */
static const int64_t filter_widest_us = INT64_C(1) << 30;
static const int32_t filter_fastest_ppb = 500000;

static int64_t filter_least(int64_t first, int64_t second)
{
  return (first < second) ? first : second;
}

static int64_t filter_most(int64_t first, int64_t second)
{
  return (first > second) ? first : second;
}

static int64_t filter_within(int64_t value, int64_t limit)
{
  return filter_most(-limit, filter_least(value, limit));
}

int64_t xrce_time_filter_estimate(const xrce_time_filter_t * filter, int64_t now_ns)
{
  const int64_t passed = now_ns - filter->local_ns;

  return filter->reference_ns + passed + xrce_time_scaled(passed, filter->drift_ppb, filter_ppb);
}

/* Returns the covariance at a later moment: the drift may have changed, and the offset with it. */
static xrce_time_variance_t filter_later(const xrce_time_filter_t * filter, int64_t now_ns)
{
  const int64_t passed_ms =
    filter_most(filter_least((now_ns - filter->local_ns) / filter_ns_per_ms, filter_longest_ms), 0);
  xrce_time_variance_t later = filter->variance;
  int64_t turned;

  later.drift = filter_least(later.drift + ((filter_wander * passed_ms) / 1000), filter_most_drift);
  turned = xrce_time_scaled(later.drift, passed_ms, filter_us_per_ppb_ms);
  later.offset += xrce_time_scaled((2 * later.both) + turned, passed_ms, filter_us_per_ppb_ms) + 1;
  later.offset = filter_within(later.offset, filter_most_offset);
  later.both += turned;
  return later;
}

/* Returns the integer square root, by bits from the highest. `value` is not negative. */
static int64_t filter_root(int64_t value)
{
  int64_t root = 0;

  for (int64_t bit = INT64_C(1) << 31; bit != 0; bit /= 2) {
    const int64_t tried = root + bit;

    if (tried <= (value / tried)) {
      root = tried;
    }
  }
  return root;
}

int64_t xrce_time_filter_uncertainty(const xrce_time_filter_t * filter, int64_t now_ns)
{
  const xrce_time_variance_t later = filter_later(filter, now_ns);

  return filter_root(filter_most(later.offset, 1)) * filter_ns_per_us;
}

static void filter_correct(
  xrce_time_filter_t * filter, xrce_time_variance_t prior, int64_t noise, int64_t residual_ns)
{
  const int64_t sum = prior.offset + noise;
  const int64_t bound =
    filter_root(prior.offset) * filter_root(prior.drift); /* of the covariance, by Cauchy and Schwarz */
  const int64_t both = filter_within(prior.both, bound);
  const int64_t larger = filter_most(prior.offset, noise);
  const int64_t smaller = filter_least(prior.offset, noise);
  const int64_t by_offset = (prior.offset * filter_one) / sum;
  const int64_t by_drift = (both * filter_one) / sum; /* ppb for each microsecond */
  const int64_t kept = (noise * filter_one) / sum;
  const int64_t drift_ppb = filter->drift_ppb + ((by_drift * (residual_ns / filter_ns_per_us)) / filter_one);

  filter->reference_ns += xrce_time_scaled(residual_ns, by_offset, filter_one);
  filter->drift_ppb = (int32_t)filter_within(drift_ppb, filter_fastest_ppb);
  filter->variance.offset =
    filter_most(xrce_time_scaled(smaller, (larger * filter_one) / sum, filter_one), 1);
  filter->variance.both = xrce_time_scaled(both, kept, filter_one);
  filter->variance.drift =
    filter_most(prior.drift - xrce_time_scaled(both, by_drift, filter_one), filter_least_drift);
}

/* Begins again with this sample. What is known of the drift remains a first guess. */
static void filter_begin(xrce_time_filter_t * filter, const xrce_time_sample_t * sample, int64_t noise)
{
  filter->local_ns = sample->local_ns;
  filter->reference_ns = sample->reference_ns;
  filter->variance.offset = noise;
  filter->variance.both = 0;
  filter->variance.drift = (filter->variance.drift == 0)
                             ? filter_first_drift
                             : filter_most(filter->variance.drift, filter_first_drift / 100);
}

/* Returns whether the sample is as far away as the uncertainties say. */
static bool filter_agrees(int64_t residual_ns, int64_t sum)
{
  const int64_t away = filter_within(residual_ns / filter_ns_per_us, filter_widest_us);

  return (away * away) <= (sum * FILTER_SIGMAS * FILTER_SIGMAS);
}

bool xrce_time_filter_sample(xrce_time_filter_t * filter, const xrce_time_sample_t * sample, int64_t now_ns)
{
  const int64_t deviation = filter_most(sample->uncertainty_ns / filter_ns_per_us, 1);
  const int64_t noise = deviation * deviation;
  const bool is_first = filter->variance.offset == 0;
  const xrce_time_variance_t prior = filter_later(filter, sample->local_ns);
  const int64_t guess_ns = xrce_time_filter_estimate(filter, sample->local_ns);
  const int64_t residual_ns = is_first ? 0 : (sample->reference_ns - guess_ns);
  const bool agrees = is_first || filter_agrees(residual_ns, prior.offset + noise);
  int64_t served_ns;

  if (!agrees && (filter->outliers < (FILTER_OUTLIERS - 1))) {
    ++filter->outliers;
    ++filter->rejected;
    return false;
  }
  served_ns = filter->is_set ? xrce_time_served(filter, now_ns) : 0;
  if (is_first || !agrees) {
    filter_begin(filter, sample, noise);
  } else {
    filter->reference_ns = guess_ns;
    filter->local_ns = sample->local_ns;
    filter_correct(filter, prior, noise, residual_ns);
  }
  filter->outliers = 0;
  ++filter->accepted;
  xrce_time_serve(filter, filter->is_set ? served_ns : xrce_time_filter_estimate(filter, now_ns), now_ns);
  filter->is_set = true;
  return true;
}

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
