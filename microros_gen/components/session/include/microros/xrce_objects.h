/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The entities of a client: what the application wants, and what the agent has of it. They stay in these tables over a
 * lost session, so that creating them again is the code that created them first.
 */
#ifndef MICROROS_XRCE_OBJECTS_H
#define MICROROS_XRCE_OBJECTS_H

#include <stdbool.h>
#include <stdint.h>

#include "microros/message_type.h"
#include "microros/xrce_forward.h"

/* `level` counts the objects that exist at the agent, in the order of their creation. */
typedef struct xrce_object_state_t {
  bool wanted;   /* the application has it open */
  bool stale;    /* what is at the agent belongs to a former owner of this place: delete it first */
  uint8_t level;
} xrce_object_state_t;

enum { XRCE_PARTICIPANT_COMPLETE = 1, XRCE_WRITER_COMPLETE = 3 };

/* A node's participant. The strings live as long as the place is taken. */
typedef struct xrce_participant_t {
  const char * name;
  const char * namespace_; /* "/" or "/a/b" */
  uint16_t domain_id;
  xrce_object_state_t state;
} xrce_participant_t;

/* A publisher's topic, publisher and data writer. */
typedef struct xrce_writer_t {
  xrce_client_t * client;
  const microros_message_type_t * type;
  const char * topic; /* fully qualified, "/chatter" */
  uint16_t depth;
  uint16_t index;       /* its place in the table */
  uint16_t participant; /* its node's place */
  uint8_t qos;          /* XRCE_QOS_ */
  xrce_object_state_t state;
} xrce_writer_t;

#endif /* MICROROS_XRCE_OBJECTS_H */
