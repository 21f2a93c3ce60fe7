/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads a micro_ros_msgs/msg/Graph of any size byte by byte, and keeps one node, one entity and one type at
 * a time. Internal. */
#ifndef MICROROS_RCL_GRAPH_CDR_H
#define MICROROS_RCL_GRAPH_CDR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Ends with a NUL. */
typedef struct rcl_graph_text_t {
  char data[MICROROS_GRAPH_NAME_SIZE];
  uint16_t size;  /* without the NUL */
  bool truncated; /* the text is longer */
} rcl_graph_text_t;

typedef enum rcl_graph_part_t {
  RCL_GRAPH_PART_NODE,   /* `node` is known */
  RCL_GRAPH_PART_ENTITY, /* `entity` and `kind` too */
  RCL_GRAPH_PART_TYPE    /* and one of its types */
} rcl_graph_part_t;

/* The part of the message that is read. */
typedef enum rcl_graph_step_t {
  RCL_GRAPH_STEP_NODES,
  RCL_GRAPH_STEP_NAMESPACE_SIZE,
  RCL_GRAPH_STEP_NAMESPACE,
  RCL_GRAPH_STEP_NODE_SIZE,
  RCL_GRAPH_STEP_NODE,
  RCL_GRAPH_STEP_ENTITIES,
  RCL_GRAPH_STEP_KIND,
  RCL_GRAPH_STEP_ENTITY_SIZE,
  RCL_GRAPH_STEP_ENTITY,
  RCL_GRAPH_STEP_TYPES,
  RCL_GRAPH_STEP_TYPE_SIZE,
  RCL_GRAPH_STEP_TYPE,
  RCL_GRAPH_STEP_END
} rcl_graph_step_t;

typedef struct rcl_graph_cdr_t {
  uint32_t at;     /* bytes that were read */
  uint32_t number; /* that is read, of which `bytes` are known */
  uint32_t left;   /* bytes of the text that is read, with its NUL */
  uint32_t nodes;  /* that are left, with the one that is read */
  uint32_t entities;
  uint32_t types;
  uint32_t hash; /* of all bytes */
  rcl_graph_step_t step;
  uint8_t bytes;
  uint8_t kind; /* of the entity: rcl_graph_kind_t */
  bool big_endian;
  rcl_graph_text_t node; /* fully qualified */
  rcl_graph_text_t entity;
  rcl_graph_text_t type;
} rcl_graph_cdr_t;

/* Called for each part in the order of the message. */
typedef void (*rcl_graph_part_callback_t)(const rcl_graph_cdr_t * cdr, rcl_graph_part_t part);

/* Begins a message. */
void rcl_graph_cdr_begin(rcl_graph_cdr_t * cdr, bool big_endian);

/* Reads the next bytes. Whatever they are, each is read once. */
void rcl_graph_cdr_take(
  rcl_graph_cdr_t * cdr, const uint8_t * bytes, size_t size, rcl_graph_part_callback_t callback);

/* Returns whether the message is complete; bytes after it are ignored. */
static inline bool rcl_graph_cdr_is_complete(const rcl_graph_cdr_t * cdr)
{
  return cdr->step == RCL_GRAPH_STEP_END;
}

/* Returns whether a text is known, and equal to another one. */
bool rcl_graph_text_equals(const rcl_graph_text_t * text, const char * other);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_GRAPH_CDR_H */
