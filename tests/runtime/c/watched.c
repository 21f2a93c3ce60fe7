/* SPDX-License-Identifier: Apache-2.0 */
/* The application of udp.c, which has a callback: prints each state and its reason. */
#define main application_main
#include "udp.c"
#undef main

static void print_event(const rmw_uros_session_event_t * event, void * argument)
{
  (void)argument;
  printf("%d %d\n", (int)event->state, (int)event->reason);
}

int main(void)
{
  return rmw_uros_set_session_callback(print_event, NULL) == RMW_RET_OK ? application_main() : 1;
}
