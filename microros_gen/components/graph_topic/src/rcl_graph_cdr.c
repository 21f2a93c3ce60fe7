/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcl_graph_cdr.h"

#include "microros/text.h"

#include <string.h>

/* FNV-1a: tells whether a message differs from the last one. */
enum { CDR_NUMBER_SIZE = 4, CDR_HASH_PRIME = 16777619 };

void rcl_graph_cdr_begin(rcl_graph_cdr_t * cdr, bool big_endian)
{
  static const uint32_t hash_basis = 2166136261u;

  (void)memset(cdr, 0, sizeof(*cdr));
  cdr->step = RCL_GRAPH_STEP_NODES;
  cdr->hash = hash_basis;
  cdr->big_endian = big_endian;
}

bool rcl_graph_text_equals(const rcl_graph_text_t * text, const char * other)
{
  return !text->truncated && microros_text_equals(text->data, other);
}

static void cdr_clear(rcl_graph_text_t * text)
{
  text->data[0] = '\0';
  text->size = 0;
  text->truncated = false;
}

static void cdr_append(rcl_graph_text_t * text, char character)
{
  if ((size_t)text->size + 1u == sizeof(text->data)) {
    text->truncated = true;
    return;
  }
  text->data[text->size] = character;
  ++text->size;
  text->data[text->size] = '\0';
}

/* Returns the text that is read. */
static rcl_graph_text_t * cdr_text(rcl_graph_cdr_t * cdr)
{
  if (cdr->step == RCL_GRAPH_STEP_TYPE) {
    return &cdr->type;
  }
  return cdr->step == RCL_GRAPH_STEP_ENTITY ? &cdr->entity : &cdr->node;
}

/* Moves on after the last entity of a node. */
static void cdr_end_node(rcl_graph_cdr_t * cdr)
{
  --cdr->nodes;
  cdr->step = cdr->nodes != 0u ? RCL_GRAPH_STEP_NAMESPACE_SIZE : RCL_GRAPH_STEP_END;
}

/* Moves on after the last type of an entity. */
static void cdr_end_entity(rcl_graph_cdr_t * cdr)
{
  --cdr->entities;
  if (cdr->entities != 0u) {
    cdr->step = RCL_GRAPH_STEP_KIND;
  } else {
    cdr_end_node(cdr);
  }
}

/* Moves on after a text. */
static void cdr_end_text(rcl_graph_cdr_t * cdr, rcl_graph_part_callback_t callback)
{
  const rcl_graph_step_t step = cdr->step;

  if (step == RCL_GRAPH_STEP_NAMESPACE) {
    if (cdr->node.size == 0u || cdr->node.data[cdr->node.size - 1u] != '/') {
      cdr_append(&cdr->node, '/');
    }
    cdr->step = RCL_GRAPH_STEP_NODE_SIZE;
  } else if (step == RCL_GRAPH_STEP_NODE) {
    callback(cdr, RCL_GRAPH_PART_NODE);
    cdr->step = RCL_GRAPH_STEP_ENTITIES;
  } else if (step == RCL_GRAPH_STEP_ENTITY) {
    callback(cdr, RCL_GRAPH_PART_ENTITY);
    cdr->step = RCL_GRAPH_STEP_TYPES;
  } else {
    callback(cdr, RCL_GRAPH_PART_TYPE);
    --cdr->types;
    cdr->step = RCL_GRAPH_STEP_TYPE_SIZE;
    if (cdr->types == 0u) {
      cdr_end_entity(cdr);
    }
  }
}

/* Begins a text of `cdr->number` bytes. */
static void cdr_begin_text(rcl_graph_cdr_t * cdr, rcl_graph_step_t step, rcl_graph_part_callback_t callback)
{
  cdr->step = step;
  cdr->left = cdr->number;
  if (step != RCL_GRAPH_STEP_NODE) { /* the node's name follows its namespace in the same text */
    cdr_clear(cdr_text(cdr));
  }
  if (cdr->left == 0u) {
    cdr_end_text(cdr, callback);
  }
}

/* Moves on after a number. */
static void cdr_end_number(rcl_graph_cdr_t * cdr, rcl_graph_part_callback_t callback)
{
  const uint32_t number = cdr->number;

  switch (cdr->step) {
    case RCL_GRAPH_STEP_NODES:
      cdr->nodes = number;
      cdr->step = number != 0u ? RCL_GRAPH_STEP_NAMESPACE_SIZE : RCL_GRAPH_STEP_END;
      break;
    case RCL_GRAPH_STEP_NAMESPACE_SIZE:
      cdr_begin_text(cdr, RCL_GRAPH_STEP_NAMESPACE, callback);
      break;
    case RCL_GRAPH_STEP_NODE_SIZE:
      cdr_begin_text(cdr, RCL_GRAPH_STEP_NODE, callback);
      break;
    case RCL_GRAPH_STEP_ENTITIES:
      cdr->entities = number;
      cdr->step = RCL_GRAPH_STEP_KIND;
      if (number == 0u) {
        cdr_end_node(cdr);
      }
      break;
    case RCL_GRAPH_STEP_ENTITY_SIZE:
      cdr_begin_text(cdr, RCL_GRAPH_STEP_ENTITY, callback);
      break;
    case RCL_GRAPH_STEP_TYPES:
      cdr->types = number;
      cdr->step = RCL_GRAPH_STEP_TYPE_SIZE;
      if (number == 0u) {
        cdr_end_entity(cdr);
      }
      break;
    case RCL_GRAPH_STEP_TYPE_SIZE:
      cdr_begin_text(cdr, RCL_GRAPH_STEP_TYPE, callback);
      break;
    case RCL_GRAPH_STEP_NAMESPACE:
    case RCL_GRAPH_STEP_NODE:
    case RCL_GRAPH_STEP_KIND:
    case RCL_GRAPH_STEP_ENTITY:
    case RCL_GRAPH_STEP_TYPE:
    case RCL_GRAPH_STEP_END:
    default: /* no numbers */
      break;
  }
}

/* Reads a byte of a number, or of the padding before it. */
static void cdr_take_of_number(rcl_graph_cdr_t * cdr, uint8_t byte, rcl_graph_part_callback_t callback)
{
  if (cdr->bytes == 0u) {
    if (cdr->at % (uint32_t)CDR_NUMBER_SIZE != 0u) {
      return;
    }
    cdr->number = 0;
  }
  if (cdr->big_endian) {
    cdr->number = (cdr->number << 8) | byte;
  } else {
    cdr->number |= (uint32_t)byte << (8u * cdr->bytes);
  }
  ++cdr->bytes;
  if (cdr->bytes == (uint8_t)CDR_NUMBER_SIZE) {
    cdr->bytes = 0;
    cdr_end_number(cdr, callback);
  }
}

static void cdr_take_of_text(rcl_graph_cdr_t * cdr, uint8_t byte, rcl_graph_part_callback_t callback)
{
  --cdr->left;
  if (cdr->left != 0u) {
    cdr_append(cdr_text(cdr), (char)byte);
  } else {
    cdr_end_text(cdr, callback); /* the last byte is a NUL */
  }
}

void rcl_graph_cdr_take(
  rcl_graph_cdr_t * cdr, const uint8_t * bytes, size_t size, rcl_graph_part_callback_t callback)
{
  for (size_t i = 0; i < size && cdr->step != RCL_GRAPH_STEP_END; ++i) {
    cdr->hash = (cdr->hash ^ bytes[i]) * (uint32_t)CDR_HASH_PRIME;
    if (cdr->step == RCL_GRAPH_STEP_KIND) {
      cdr->kind = bytes[i];
      cdr->step = RCL_GRAPH_STEP_ENTITY_SIZE;
    } else if (
      cdr->step == RCL_GRAPH_STEP_NAMESPACE || cdr->step == RCL_GRAPH_STEP_NODE ||
      cdr->step == RCL_GRAPH_STEP_ENTITY || cdr->step == RCL_GRAPH_STEP_TYPE) {
      cdr_take_of_text(cdr, bytes[i], callback);
    } else {
      cdr_take_of_number(cdr, bytes[i], callback);
    }
    ++cdr->at;
  }
}
