/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The filter of a time source, alone. Each line of the input is an order:
 *   s LOCAL REFERENCE UNCERTAINTY NOW   a sample; prints 1 or 0, whether it was taken
 *   r NOW                               prints the time that is served, the estimate, and its uncertainty
 *   d                                   prints the drift, and the counts of samples, outliers and steps
 *   w                                   a sleep */
#include "microros/xrce_time_filter.h"

#include <inttypes.h>
#include <stdio.h>

static void sample(xrce_time_filter_t * filter, const int64_t * number)
{
  const xrce_time_sample_t given = {number[0], number[1], number[2]};

  (void)printf("%d\n", xrce_time_filter_sample(filter, &given, number[3]) ? 1 : 0);
}

static void order(xrce_time_filter_t * filter, char what, const int64_t * number)
{
  switch (what) {
    case 's':
      sample(filter, number);
      break;
    case 'r':
      (void)printf(
        "%" PRId64 " %" PRId64 " %" PRId64 "\n", xrce_time_served(filter, number[0]),
        xrce_time_filter_estimate(filter, number[0]), xrce_time_filter_uncertainty(filter, number[0]));
      break;
    case 'd':
      (void)printf(
        "%" PRId32 " %" PRIu32 " %" PRIu32 " %" PRIu32 "\n", filter->drift_ppb, filter->accepted,
        filter->rejected, filter->steps);
      break;
    default:
      filter->is_set = false;
      filter->variance.offset = 0;
      (void)printf("-\n");
      break;
  }
}

int main(void)
{
  static xrce_time_filter_t filter;
  char line[160];

  while (fgets(line, (int)sizeof(line), stdin) != NULL) {
    int64_t number[4] = {0, 0, 0, 0};
    char what = '\0';

    if (
      sscanf(
        line, " %c %" SCNd64 " %" SCNd64 " %" SCNd64 " %" SCNd64, &what, &number[0], &number[1], &number[2],
        &number[3]) < 1) {
      return 1;
    }
    order(&filter, what, number);
  }
  return 0;
}
