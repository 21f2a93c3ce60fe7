/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Several agents (`transport: {agents: [...]}`): which one the session is with. An addition of this client
 * to rmw_microros.
 */
#ifndef MICROROS_RMW_MICROROS_AGENTS_H
#define MICROROS_RMW_MICROROS_AGENTS_H

#include <stdint.h>

#include "rmw/init.h"
#include "rmw/ret_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An agent: of the open session, or without one the agent that is being tried. */
typedef struct rmw_uros_agent_t {
  const char * host; /* numeric address, or serial device; valid until rcl_shutdown */
  uint16_t port;     /* 0: of a serial device */
  uint8_t index;     /* in `agents`, from 0; MICROROS_AGENTS: an address that the application set itself */
  uint32_t changes;  /* sessions with another agent than the one before, since rcl_init */
} rmw_uros_agent_t;

/*
 * Writes the agent to `agent`. Does not wait. RMW_RET_INVALID_ARGUMENT: NULL, or a context without a session.
 *
 * An address or device that the application sets (rmw_uros_options_set_udp_address, …_set_serial_device) and that is in
 * `agents` is tried first; another one is used alone.
 */
rmw_ret_t rmw_uros_get_agent(const rmw_context_t * context, rmw_uros_agent_t * agent);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_MICROROS_AGENTS_H */
