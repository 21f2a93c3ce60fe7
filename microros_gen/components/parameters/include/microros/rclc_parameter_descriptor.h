/* SPDX-License-Identifier: Apache-2.0 */
/* Parts of messages that describe a parameter and its node. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_DESCRIPTOR_H
#define MICROROS_RCLC_PARAMETER_DESCRIPTOR_H

#include <stddef.h>
#include <stdint.h>

#include "microros/rclc_parameter_out.h"
#include "microros/rclc_parameters.h"
#include "microros/text.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The fully qualified name: the root namespace "/" already ends with a slash. */
static inline void rclc_parameter_out_node(parameter_out_t * out, const rcl_node_t * node)
{
  const char * namespace_ = rcl_node_get_namespace(node);
  const char * name = rcl_node_get_name(node);
  const uint32_t size = (uint32_t)microros_text_size(namespace_);
  const parameter_text_t parts[3] = {
    {namespace_, size}, {"/", size > 1u ? 1u : 0u}, {name, (uint32_t)microros_text_size(name)}};

  rclc_parameter_out_parts(out, parts, 3u);
}

/* Writes the range of a type as a sequence; an empty one where the parameter has another type, or none. */
static inline void rclc_parameter_out_range(
  parameter_out_t * out, const rclc_parameter_place_t * place, rclc_parameter_type_t type)
{
  const rclc_parameter_range_t * range = place->type == (uint8_t)type ? place->about->range : NULL;

  rclc_parameter_out_4(out, range != NULL ? 1u : 0u);
  if (range != NULL) { /* of either type: three numbers of 8 bytes */
    rclc_parameter_out_8(out, &range->integer.from_value);
    rclc_parameter_out_8(out, &range->integer.to_value);
    rclc_parameter_out_8(out, &range->integer.step);
  }
}

/* Writes an rcl_interfaces/msg/ParameterDescriptor of that name. */
static inline void rclc_parameter_out_descriptor(
  parameter_out_t * out, const parameter_text_t * name, const rclc_parameter_place_t * place)
{
  const char * texts = place->about->texts != NULL ? place->about->texts : "\0";

  rclc_parameter_out_parts(out, name, 1u);
  rclc_parameter_out_1(out, place->type);
  rclc_parameter_out_text(out, texts);
  rclc_parameter_out_text(out, &texts[microros_text_size(texts) + 1u]);
  rclc_parameter_out_1(out, place->read_only ? 1u : 0u);
  rclc_parameter_out_1(out, place->dynamic_typing ? 1u : 0u);
  rclc_parameter_out_range(out, place, RCLC_PARAMETER_DOUBLE);
  rclc_parameter_out_range(out, place, RCLC_PARAMETER_INT);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_DESCRIPTOR_H */
