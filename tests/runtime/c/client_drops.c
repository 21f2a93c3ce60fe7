/* SPDX-License-Identifier: Apache-2.0 */
/* What each publisher dropped, in the hands of the test. */
#include "client.h"
#include "types.h"

#include <rclc/rclc.h>
#include <rmw_microros/publisher.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

int client_extra(char ** word, rclc_support_t * session);

/* extra_dropped PUBLISHER */
int client_extra(char ** word, rclc_support_t * session)
{
  const rcl_publisher_t * publisher = &publishers[atoi(word[1])];
  rmw_uros_publisher_statistics_t statistics;
  const rmw_ret_t result =
    rmw_uros_get_publisher_statistics(rcl_publisher_get_rmw_handle(publisher), &statistics);

  (void)session;
  if (result == RMW_RET_OK) {
    printf("%" PRIu32 "\n", statistics.dropped);
  }
  return result;
}
