/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A client: the state declared by the selected components. One session with one agent. The library's other
 * state are handles of nodes and endpoints, and what the plan sizes by messages, as variables of the sources
 * that use it: the input buffer, the samples of queues, the messages of output streams. Small members that
 * loops go over precede the session: their offsets have short instructions.
 */
#ifndef MICROROS_XRCE_CLIENT_H
#define MICROROS_XRCE_CLIENT_H

#include "microros/xrce_creation.h"
#include "microros/xrce_ping.h"
#include "microros/xrce_stream_reliable.h"
#include "microros/xrce_time_sync.h"
#include "microros/xrce_watch.h"
#include "microros/xrce_objects.h"
#include "microros/xrce_session.h"
#include "microros_config.h"

#include <stdint.h>

struct xrce_client_t {
  xrce_object_state_t states[XRCE_PLACES];
  xrce_entities_t entities;
  xrce_session_t session;
  xrce_stream_reliable_t reliable;
  xrce_ping_t ping;
  xrce_watch_t watch;
  xrce_time_sync_t time_sync;
  uint32_t create_timeout_ms;
  uint32_t close_timeout_ms;
  xrce_participant_t participants[MICROROS_NODES_MAX];
  xrce_endpoint_t endpoints[XRCE_ENDPOINTS];
};

#endif /* MICROROS_XRCE_CLIENT_H */
