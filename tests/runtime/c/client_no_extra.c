/* SPDX-License-Identifier: Apache-2.0 */
/* A plan without the additions that client_extra.c is about. */
#include "types.h"

#include <rclc/rclc.h>

int client_extra(char ** word, rclc_support_t * session);

int client_extra(char ** word, rclc_support_t * session)
{
  (void)word;
  (void)session;
  return -1;
}
