/* SPDX-License-Identifier: Apache-2.0 */
#include <rcl/init_options.h>
#include <rmw_microros/rmw_microros.h>

#include <stdlib.h>
#include <string.h>

int client_ping(char ** word);

/* ping_discover: whatever address it finds */
static int discover(void)
{
#ifdef MICROROS_DISCOVERY_PORT
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();

  if (rcl_init_options_init(&options, rcl_get_default_allocator()) != 0) {
    return -1;
  }
  return rmw_uros_discover_agent(rcl_init_options_get_rmw_init_options(&options));
#else
  return -1;
#endif
}

/* ping TIMEOUT ATTEMPTS, ping_options TIMEOUT ATTEMPTS HOST PORT */
int client_ping(char ** word)
{
  const int timeout_ms = atoi(word[1]);
  const uint8_t attempts = (uint8_t)atoi(word[2]);
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  rmw_init_options_t * rmw;

  if (strcmp(word[0], "ping_discover") == 0) {
    return discover();
  }
  if (strcmp(word[0], "ping") == 0) {
    return rmw_uros_ping_agent(timeout_ms, attempts);
  }
  if (rcl_init_options_init(&options, rcl_get_default_allocator()) != 0) {
    return -1;
  }
  rmw = rcl_init_options_get_rmw_init_options(&options);
#if defined(RMW_UXRCE_TRANSPORT_UDP)
  if (rmw_uros_options_set_udp_address(word[3], word[4], rmw) != RMW_RET_OK) {
    return -1;
  }
#elif defined(RMW_UXRCE_TRANSPORT_TCP)
  if (rmw_uros_options_set_tcp_address(word[3], word[4], rmw) != RMW_RET_OK) {
    return -1;
  }
#endif
  return rmw_uros_ping_agent_options(timeout_ms, attempts, rmw);
}
