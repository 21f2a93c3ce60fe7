/* SPDX-License-Identifier: Apache-2.0 */
#include <rmw_microros/rmw_microros.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int client_time(char ** word);

/* epoch_sync TIMEOUT, epoch_now */
int client_time(char ** word)
{
  if (strcmp(word[0], "epoch_sync") == 0) {
    return rmw_uros_sync_session(atoi(word[1]));
  }
  printf("epoch %" PRId64 " %" PRId64 "\n", rmw_uros_epoch_millis(), rmw_uros_epoch_nanos());
  return rmw_uros_epoch_synchronized() ? 1 : 0;
}
