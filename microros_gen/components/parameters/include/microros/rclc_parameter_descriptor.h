/* SPDX-License-Identifier: Apache-2.0 */
/* Parts of messages that say what a parameter and its node are. Internal. */
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

/* The fully qualified name: the namespace ends with the only slash where it is "/". */
static inline void rclc_parameter_out_node(parameter_out_t * out, const rcl_node_t * node)
{
  const char * namespace_ = rcl_node_get_namespace(node);
  const char * name = rcl_node_get_name(node);
  const uint32_t size = (uint32_t)microros_text_size(namespace_);
  const parameter_text_t parts[3] = {
    {namespace_, size}, {"/", size > 1u ? 1u : 0u}, {name, (uint32_t)microros_text_size(name)}};

  rclc_parameter_out_parts(out, parts, 3u);
}

static inline void rclc_parameter_out_ranges(parameter_out_t * out, const rclc_parameter_place_t * place)
{
  const bool integers = place != NULL && place->has_range && place->type == (uint8_t)RCLC_PARAMETER_INT;
  const bool numbers = place != NULL && place->has_range && place->type == (uint8_t)RCLC_PARAMETER_DOUBLE;

  rclc_parameter_out_4(out, numbers ? 1u : 0u);
  if (numbers) {
    rclc_parameter_out_8(out, &place->range.floating_point.from_value);
    rclc_parameter_out_8(out, &place->range.floating_point.to_value);
    rclc_parameter_out_8(out, &place->range.floating_point.step);
  }
  rclc_parameter_out_4(out, integers ? 1u : 0u);
  if (integers) {
    rclc_parameter_out_8(out, &place->range.integer.from_value);
    rclc_parameter_out_8(out, &place->range.integer.to_value);
    rclc_parameter_out_8(out, &place->range.integer.step);
  }
}

/* Writes an rcl_interfaces/msg/ParameterDescriptor; of no type for a NULL place. */
static inline void rclc_parameter_out_descriptor(
  parameter_out_t * out, const parameter_text_t * name, const rclc_parameter_place_t * place)
{
  rclc_parameter_out_parts(out, name, 1u);
  rclc_parameter_out_1(out, place != NULL ? place->type : (uint8_t)RCLC_PARAMETER_NOT_SET);
  rclc_parameter_out_text(out, place != NULL ? place->description : "");
  rclc_parameter_out_text(out, place != NULL ? place->additional_constraints : "");
  rclc_parameter_out_1(out, place != NULL && place->read_only ? 1u : 0u);
  rclc_parameter_out_1(out, place != NULL && place->dynamic_typing ? 1u : 0u);
  rclc_parameter_out_ranges(out, place);
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_DESCRIPTOR_H */
