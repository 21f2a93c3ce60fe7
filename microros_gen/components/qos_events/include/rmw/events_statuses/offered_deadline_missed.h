/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_RMW_EVENTS_STATUSES_OFFERED_DEADLINE_MISSED_H
#define MICROROS_RMW_EVENTS_STATUSES_OFFERED_DEADLINE_MISSED_H

#include <stdint.h>

/* Periods without a message since the event was initialized, and since it was last taken. */
typedef struct rmw_offered_deadline_missed_status_s {
  int32_t total_count;
  int32_t total_count_change;
} rmw_offered_deadline_missed_status_t;

#endif /* MICROROS_RMW_EVENTS_STATUSES_OFFERED_DEADLINE_MISSED_H */
