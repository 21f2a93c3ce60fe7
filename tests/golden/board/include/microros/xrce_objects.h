/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Entities of a client: what the application wants and what exists at the agent. The tables survive a lost
 * session, so that re-creation uses the same code as creation.
 */
#ifndef MICROROS_XRCE_OBJECTS_H
#define MICROROS_XRCE_OBJECTS_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/message_type.h"
#include "microros/xrce_forward.h"
#include "microros/xrce_local.h"
#include "microros/xrce_object_state.h"
#include "microros_config.h"

/*
 * Places: nodes first, then their endpoints by kind. Receiving kinds come last, so that tables for
 * receivers only can start there.
 */
enum {
  XRCE_WRITERS_AT = MICROROS_NODES_MAX,
  XRCE_READERS_AT = XRCE_WRITERS_AT + MICROROS_PUBLISHERS_MAX,
  XRCE_REPLIERS_AT = XRCE_READERS_AT + MICROROS_SUBSCRIPTIONS_MAX,
  XRCE_REQUESTERS_AT = XRCE_REPLIERS_AT + MICROROS_SERVICES_MAX,
  XRCE_PLACES = XRCE_REQUESTERS_AT + MICROROS_CLIENTS_MAX
};

enum {
  XRCE_ENDPOINTS = XRCE_PLACES - MICROROS_NODES_MAX,
  XRCE_RECEIVERS = XRCE_PLACES - XRCE_READERS_AT,
  XRCE_SERVICES = XRCE_PLACES - XRCE_REPLIERS_AT /* including their clients */
};

/* Levels of a participant, of a writer or reader with its topic, and of a replier or requester. */
enum { XRCE_PARTICIPANT_COMPLETE = 1, XRCE_ENDPOINT_COMPLETE = 3, XRCE_SERVICE_COMPLETE = 1 };

/* A node's participant. The strings are valid as long as the place is in use. */
typedef struct xrce_participant_t {
  const char * name;
  const char * namespace_; /* "/" or "/a/b" */
  uint16_t domain_id;
} xrce_participant_t;

/* An endpoint of a node: a topic with publisher and data writer, or with subscriber and data reader; a
 * replier or a requester. */
typedef struct xrce_endpoint_t {
  xrce_client_t * client;
  const microros_message_type_t * type;
  const char * name; /* fully qualified, "/chatter" */
  uint16_t depth;
  uint16_t index;       /* among the endpoints, and of its objects: its place minus the number of nodes */
  uint16_t participant; /* its node's place */
  uint8_t qos;          /* XRCE_QOS_ */
} xrce_endpoint_t;

/* Return whether a place belongs to a participant, a data reader, or a service. */
static inline bool xrce_place_is_participant(uint16_t place)
{
  return place < MICROROS_NODES_MAX;
}

static inline bool xrce_place_is_reader(uint16_t place)
{
  /* cppcheck-suppress incorrectLogicOperator ; a plan without subscriptions has none */
  return MICROROS_SUBSCRIPTIONS_MAX != 0u && place >= XRCE_READERS_AT && place < XRCE_REPLIERS_AT;
}

static inline bool xrce_place_is_service(uint32_t place)
{
  return XRCE_SERVICES != 0 && place >= XRCE_REPLIERS_AT;
}

/* Returns how many objects a complete place has at the agent. */
static inline uint8_t xrce_place_complete(uint16_t place)
{
  if (xrce_place_is_local(place)) {
    return 0;
  }
  if (xrce_place_is_service(place)) {
    return XRCE_SERVICE_COMPLETE;
  }
  return place < MICROROS_NODES_MAX ? (uint8_t)XRCE_PARTICIPANT_COMPLETE : (uint8_t)XRCE_ENDPOINT_COMPLETE;
}

#endif /* MICROROS_XRCE_OBJECTS_H */
