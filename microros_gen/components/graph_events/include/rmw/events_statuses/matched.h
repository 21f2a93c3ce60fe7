/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_RMW_EVENTS_STATUSES_MATCHED_H
#define MICROROS_RMW_EVENTS_STATUSES_MATCHED_H

#include <stddef.h>
#include <stdint.h>

/* Endpoints that match: all since the event was initialized, those that match now, and both since it was last taken. */
typedef struct rmw_matched_status_s {
  size_t total_count;
  size_t total_count_change;
  size_t current_count;
  int32_t current_count_change;
} rmw_matched_status_t;

#endif /* MICROROS_RMW_EVENTS_STATUSES_MATCHED_H */
