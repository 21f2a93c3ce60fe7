/* SPDX-License-Identifier: Apache-2.0 */
/* Rules of generate_parameter_library. If no parameter of the plan has one, every value is accepted. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_RULES_H
#define MICROROS_RCLC_PARAMETER_RULES_H

#include "microros/rclc_parameter_out.h"
#include "microros/rclc_parameters.h"

#ifdef __cplusplus
extern "C" {
#endif

#if MICROROS_PARAMETER_RULES > 0u

/* The first ones are about the size of a string or array, the others about a value or each element of an array. */
typedef enum parameter_rule_kind_t {
  PARAMETER_RULE_SIZE_IS,
  PARAMETER_RULE_SIZE_ABOVE,
  PARAMETER_RULE_SIZE_BELOW,
  PARAMETER_RULE_UNIQUE,
  PARAMETER_RULE_LISTED,
  PARAMETER_RULE_FROM,
  PARAMETER_RULE_TO,
  PARAMETER_RULE_WITHIN,
  PARAMETER_RULE_ABOVE,
  PARAMETER_RULE_BELOW
} parameter_rule_kind_t;

struct rclc_parameter_rule_t {
  /* Two texts, each with its NUL: the first has %n for the name, %s for the size and %v for the refused value. */
  const char * words;
  const void * values; /* `count` of them, of the type of the parameter or of its elements */
  uint32_t count;      /* for a rule about the size: that size */
  uint8_t kind;        /* a parameter_rule_kind_t */
};

/* Returns whether the requested value, which has the type of the place, follows all rules. */
bool rclc_parameter_rules_hold(const rclc_parameter_place_t * place, const parameter_requested_t * requested);

/* Writes the reason for PARAMETER_BREAKS_RULE. */
void rclc_parameter_out_rule(
  parameter_out_t * out, const rclc_parameter_server_t * server, const parameter_requested_t * requested);

/* Returns the outcome of a request whose value ROS judged. As in the library, a range of ROS comes first, and a limit of the
 * device last. */
static inline parameter_outcome_t rclc_parameter_rules_outcome(
  const rclc_parameter_place_t * place, const parameter_requested_t * requested, parameter_outcome_t outcome)
{
  if (outcome == PARAMETER_OUTSIDE_INTEGER || outcome == PARAMETER_OUTSIDE_FLOATING_POINT) {
    return outcome;
  }
  return rclc_parameter_rules_hold(place, requested) ? outcome : PARAMETER_BREAKS_RULE;
}

#else

static inline parameter_outcome_t rclc_parameter_rules_outcome(
  const rclc_parameter_place_t * place, const parameter_requested_t * requested, parameter_outcome_t outcome)
{
  (void)place;
  (void)requested;
  return outcome;
}

#endif

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_RULES_H */
