/* SPDX-License-Identifier: Apache-2.0 */
/* Strings of parameters. If no parameter of the plan is a string, these functions do nothing. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_STRING_H
#define MICROROS_RCLC_PARAMETER_STRING_H

#include "microros/rclc_parameter_declared.h"
#include "microros/rclc_parameters.h"

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

#if MICROROS_PARAMETER_STRING_SIZE > 0u

/* Returns whether the requested string fits in a place; NULL: in a free one. */
static inline bool rclc_parameter_string_fits(
  const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  return requested->type != (uint8_t)RCLC_PARAMETER_STRING ||
         requested->string.size <=
           (place != NULL ? place->about->string_most : MICROROS_PARAMETER_STRING_SIZE - 1u);
}

/* Copies a string that fits. */
static inline void rclc_parameter_string_copy(char * to, const parameter_text_t * text)
{
  (void)memcpy(to, text->data, text->size);
  to[text->size] = '\0';
}

/* Sets the string of a state to the requested one, which belongs to the server. */
static inline void rclc_parameter_string_new(
  rclc_parameter_server_t * server, const parameter_requested_t * requested, parameter_state_t * state)
{
  if (requested->type == (uint8_t)RCLC_PARAMETER_STRING) {
    rclc_parameter_string_copy(server->string_new, &requested->string);
  }
  state->string = server->string_new;
}

static inline void rclc_parameter_string_old(rclc_parameter_place_t * place, parameter_state_t * state)
{
  state->string = place->string;
}

static inline void rclc_parameter_string_set(
  rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  if (requested->type == (uint8_t)RCLC_PARAMETER_STRING) {
    rclc_parameter_string_copy(place->string, &requested->string);
  }
}

/* Sets the string of a state to the default of a declaration; returns whether it fits. */
static inline bool rclc_parameter_string_start(
  rclc_parameter_server_t * server, const rclc_parameter_declared_t * declared, parameter_state_t * state)
{
  if (declared->type == (uint8_t)RCLC_PARAMETER_STRING) {
    if (declared->start_bytes > declared->about.string_most + 1u) {
      return false;
    }
    (void)memcpy(server->string_new, declared->start, declared->start_bytes);
    state->string = server->string_new;
  }
  return true;
}

/* Copies the string of a state to a place. */
static inline void rclc_parameter_string_take(rclc_parameter_place_t * place, const parameter_state_t * state)
{
  if (state->type == (uint8_t)RCLC_PARAMETER_STRING) {
    const parameter_text_t text = rclc_parameter_text(state->string);

    rclc_parameter_string_copy(place->string, &text);
  }
}

static inline const char * rclc_parameter_string_of(const rclc_parameter_place_t * place)
{
  return place->type == (uint8_t)RCLC_PARAMETER_STRING ? place->string : "";
}

#else

static inline bool rclc_parameter_string_fits(
  const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  (void)place;
  (void)requested;
  return true;
}

static inline void rclc_parameter_string_new(
  const rclc_parameter_server_t * server, const parameter_requested_t * requested,
  const parameter_state_t * state)
{
  (void)server;
  (void)requested;
  (void)state;
}

static inline void rclc_parameter_string_old(
  const rclc_parameter_place_t * place, const parameter_state_t * state)
{
  (void)place;
  (void)state;
}

static inline void rclc_parameter_string_set(
  const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  (void)place;
  (void)requested;
}

static inline bool rclc_parameter_string_start(
  const rclc_parameter_server_t * server, const rclc_parameter_declared_t * declared,
  const parameter_state_t * state)
{
  (void)server;
  (void)declared;
  (void)state;
  return true;
}

static inline void rclc_parameter_string_take(
  const rclc_parameter_place_t * place, const parameter_state_t * state)
{
  (void)place;
  (void)state;
}

static inline const char * rclc_parameter_string_of(const rclc_parameter_place_t * place)
{
  (void)place;
  return "";
}

#endif

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_STRING_H */
