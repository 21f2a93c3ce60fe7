/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The entities of a client: what the application wants, and what the agent has of it. They stay in these
 * tables over a lost session, so that creating them again is the code that created them first.
 */
#ifndef MICROROS_XRCE_OBJECTS_H
#define MICROROS_XRCE_OBJECTS_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/message_type.h"
#include "microros/xrce_forward.h"
#include "microros_config.h"

/* Places: the nodes first, then the publishers. */
enum { XRCE_PLACES = MICROROS_NODES_MAX + MICROROS_PUBLISHERS_MAX };

enum { XRCE_PARTICIPANT_COMPLETE = 1, XRCE_WRITER_COMPLETE = 3 };

/* `level` counts the objects that exist at the agent, in the order of their creation. */
typedef struct xrce_object_state_t {
  uint8_t level;
  bool wanted; /* the application has it open */
  bool stale;  /* what is at the agent belongs to a former owner of this place: delete it first */
} xrce_object_state_t;

/* A node's participant. The strings live as long as the place is taken. */
typedef struct xrce_participant_t {
  const char * name;
  const char * namespace_; /* "/" or "/a/b" */
  uint16_t domain_id;
} xrce_participant_t;

/* A publisher's topic, publisher and data writer. */
typedef struct xrce_writer_t {
  xrce_client_t * client;
  const microros_message_type_t * type;
  const char * topic; /* fully qualified, "/chatter" */
  uint16_t depth;
  uint16_t index;       /* among the writers */
  uint16_t participant; /* its node's place */
  uint8_t qos;          /* XRCE_QOS_ */
} xrce_writer_t;

#endif /* MICROROS_XRCE_OBJECTS_H */
