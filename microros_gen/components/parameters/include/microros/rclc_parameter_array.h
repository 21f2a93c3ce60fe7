/* SPDX-License-Identifier: Apache-2.0 */
/* Arrays of parameters. If no parameter of the plan is an array, these functions do nothing. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_ARRAY_H
#define MICROROS_RCLC_PARAMETER_ARRAY_H

#include "microros/rclc_parameter_declared.h"
#include "microros/rclc_parameter_out.h"
#include "microros/rclc_parameters.h"

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The five arrays of an rcl_interfaces/msg/ParameterValue. */
enum { PARAMETER_ARRAYS = 5 };

#if MICROROS_PARAMETER_ARRAY_SIZE > 0u

/* Skips the arrays of a value, and notes the one of the requested type. */
void rclc_parameter_array_request(cdr_in_t * in, parameter_requested_t * requested);

/* Returns whether the requested array fits in a place; NULL: in a free one. */
bool rclc_parameter_array_fits(const rclc_parameter_place_t * place, const parameter_requested_t * requested);

/* Sets the array of a state to the requested one, which belongs to the server. */
void rclc_parameter_array_new(
  rclc_parameter_server_t * server, const parameter_requested_t * requested, parameter_state_t * state);

void rclc_parameter_array_old(rclc_parameter_place_t * place, parameter_state_t * state);

/* Copies an array that fits. */
void rclc_parameter_array_set(rclc_parameter_place_t * place, const parameter_requested_t * requested);

/* Shows an array to the callback; `which`: 0 the old value, 1 the new one. */
void rclc_parameter_array_present(
  rclc_parameter_server_t * server, const parameter_state_t * state, ParameterValue * value, uint32_t which);

/* Sets the array of a state to the default of a declaration; returns whether it fits. */
bool rclc_parameter_array_start(
  rclc_parameter_server_t * server, const rclc_parameter_declared_t * declared, parameter_state_t * state);

/* Copies the array of a state to a place. */
void rclc_parameter_array_take(rclc_parameter_place_t * place, const parameter_state_t * state);

/* Writes the arrays of a value, of which one at most has elements. */
void rclc_parameter_out_arrays(parameter_out_t * out, const rclc_parameter_place_t * place);

#else

static inline void rclc_parameter_array_request(cdr_in_t * in, const parameter_requested_t * requested)
{
  (void)requested;
  if (!rclc_parameter_in_pass_empty(in, (uint32_t)PARAMETER_ARRAYS)) {
    (void)rclc_parameter_in_pass(in, 1u);
    (void)rclc_parameter_in_pass(in, 1u);
    (void)rclc_parameter_in_pass(in, 8u);
    (void)rclc_parameter_in_pass(in, 8u);
    (void)rclc_parameter_in_pass_texts(in);
  }
}

static inline bool rclc_parameter_array_fits(
  const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  (void)place;
  (void)requested;
  return true;
}

static inline void rclc_parameter_array_new(
  const rclc_parameter_server_t * server, const parameter_requested_t * requested,
  const parameter_state_t * state)
{
  (void)server;
  (void)requested;
  (void)state;
}

static inline void rclc_parameter_array_old(
  const rclc_parameter_place_t * place, const parameter_state_t * state)
{
  (void)place;
  (void)state;
}

static inline void rclc_parameter_array_set(
  const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  (void)place;
  (void)requested;
}

static inline void rclc_parameter_array_present(
  const rclc_parameter_server_t * server, const parameter_state_t * state, const ParameterValue * value,
  uint32_t which)
{
  (void)server;
  (void)state;
  (void)value;
  (void)which;
}

static inline bool rclc_parameter_array_start(
  const rclc_parameter_server_t * server, const rclc_parameter_declared_t * declared,
  const parameter_state_t * state)
{
  (void)server;
  (void)declared;
  (void)state;
  return true;
}

static inline void rclc_parameter_array_take(
  const rclc_parameter_place_t * place, const parameter_state_t * state)
{
  (void)place;
  (void)state;
}

static inline void rclc_parameter_out_arrays(parameter_out_t * out, const rclc_parameter_place_t * place)
{
  const uint32_t bytes = (uint32_t)PARAMETER_ARRAYS * 4u; /* the lengths of empty ones */
  uint8_t * to = rclc_parameter_out_take(out, 4u, bytes);

  (void)place;
  if (to != NULL) {
    (void)memset(to, 0, (size_t)bytes);
  }
}

#endif

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_ARRAY_H */
