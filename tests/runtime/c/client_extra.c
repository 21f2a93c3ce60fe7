/* SPDX-License-Identifier: Apache-2.0 */
/* Additions to rmw_microros that are about the session, in the hands of the test. */
#include "types.h"

#include <rcl/rcl.h>
#include <rclc/rclc.h>
#include <rmw_microros/rmw_microros.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int client_extra(char ** word, rclc_support_t * session);

static void print_event(const rmw_uros_session_event_t * event, void * argument)
{
  printf(
    "%s %d %d losses=%" PRIu32 " reconnects=%" PRIu32 " dropped=%" PRIu32 "\n", (const char *)argument,
    (int)event->state, (int)event->reason, event->losses, event->reconnects, event->dropped);
}

/* extra_sleep FILE MS: what is in the file is all that is left of this process. */
static rcl_ret_t go_to_sleep(char ** word, rclc_support_t * session)
{
  static rmw_uros_retained_t retained;
  rmw_context_t * context = rcl_context_get_rmw_context(&session->context);
  const rmw_ret_t result = rmw_uros_sleep(context, &retained, (uint32_t)strtoul(word[2], NULL, 10));
  FILE * file;

  if (result != RMW_RET_OK) {
    return result;
  }
  file = fopen(word[1], "wb");
  if (file == NULL || fwrite(&retained, sizeof(retained), 1, file) != 1u || fclose(file) != 0) {
    return -2;
  }
  return RCL_RET_OK;
}

/* extra_wake FILE: 1 where the session goes on; then it is tried a second time, which must fail. */
static rcl_ret_t wake_up(char ** word)
{
  static rmw_uros_retained_t retained;
  FILE * file = fopen(word[1], "rb");
  bool woken;

  if (file == NULL || fread(&retained, sizeof(retained), 1, file) != 1u || fclose(file) != 0) {
    return -2;
  }
  woken = rmw_uros_wake(&retained);
  return woken && !rmw_uros_wake(&retained) ? 1 : 0;
}

int client_extra(char ** word, rclc_support_t * session)
{
  static char name[] = "event";

  if (strcmp(word[0], "extra_sleep") == 0) {
    return go_to_sleep(word, session);
  }
  if (strcmp(word[0], "extra_wake") == 0) {
    return wake_up(word);
  }
  if (strcmp(word[0], "extra_watch") == 0) {
    return rmw_uros_set_session_callback(print_event, name);
  }
  if (strcmp(word[0], "extra_unwatch") == 0) {
    return rmw_uros_set_session_callback(NULL, NULL);
  }
  return -1;
}
