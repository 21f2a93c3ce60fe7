/* SPDX-License-Identifier: Apache-2.0 */
/* Additions to rmw_microros that are about the session, in the hands of the test. */
#include "types.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

int client_extra(char ** word, rclc_support_t * session);

static void print_event(const rmw_uros_session_event_t * event, void * argument)
{
  printf(
    "%s %d %d losses=%" PRIu32 " reconnects=%" PRIu32 " dropped=%" PRIu32 "\n", (const char *)argument,
    (int)event->state, (int)event->reason, event->losses, event->reconnects, event->dropped);
}

int client_extra(char ** word, rclc_support_t * session)
{
  static char name[] = "event";

  (void)session;
  if (strcmp(word[0], "extra_watch") == 0) {
    return rmw_uros_set_session_callback(print_event, name);
  }
  if (strcmp(word[0], "extra_unwatch") == 0) {
    return rmw_uros_set_session_callback(NULL, NULL);
  }
  return -1;
}
