/* SPDX-License-Identifier: Apache-2.0 */
#include <rmw_microros/rmw_microros.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int client_time(char ** word);

/* epoch_sync TIMEOUT, epoch_stamp, epoch_now */
int client_time(char ** word)
{
  if (strcmp(word[0], "epoch_sync") == 0) {
    return rmw_uros_sync_session(atoi(word[1]));
  }
  if (strcmp(word[0], "epoch_stamp") == 0) {
    int32_t sec = -1;
    uint32_t nanosec = 1000000000u;
    const bool synchronized = rmw_uros_epoch_stamp(&sec, &nanosec);

    printf("stamp %" PRId32 " %" PRIu32 "\n", sec, nanosec);
    return !rmw_uros_epoch_stamp(NULL, &nanosec) && !rmw_uros_epoch_stamp(&sec, NULL) && synchronized ? 1 : 0;
  }
  printf("epoch %" PRId64 " %" PRId64 "\n", rmw_uros_epoch_millis(), rmw_uros_epoch_nanos());
  return rmw_uros_epoch_synchronized() ? 1 : 0;
}
