/* SPDX-License-Identifier: Apache-2.0 */
/* The commands of client_drops.c and of client_extra.c in one program. */
#define client_extra client_session
#include "client_extra.c"
#undef client_extra
#define client_extra client_drops
#include "client_drops.c"
#undef client_extra

int client_extra(char ** word, rclc_support_t * session);

int client_extra(char ** word, rclc_support_t * session)
{
  return strcmp(word[0], "extra_dropped") == 0 ? client_drops(word, session) : client_session(word, session);
}
