/* SPDX-License-Identifier: Apache-2.0 */
/* What a value has besides its scalar: a string, where a plan has any. Else these do nothing. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_STRING_H
#define MICROROS_RCLC_PARAMETER_STRING_H

#include "microros/rclc_parameters.h"

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

#if MICROROS_PARAMETER_STRING_SIZE > 0u

/* Returns whether the string that was asked for has room in a place; NULL: a free one. */
static inline bool rclc_parameter_string_fits(
  const rclc_parameter_place_t * place, const parameter_requested_t * requested)
{
  return requested->type != (uint8_t)RCLC_PARAMETER_STRING ||
         requested->string.size <= (place != NULL ? place->string_most : MICROROS_PARAMETER_STRING_SIZE - 1u);
}

/* Copies a string that fits. */
static inline void rclc_parameter_string_copy(char * to, const parameter_text_t * text)
{
  (void)memcpy(to, text->data, text->size);
  to[text->size] = '\0';
}

/* Makes the string that was asked for the one of a state; it belongs to the server. */
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

static inline const char * rclc_parameter_string_of(const rclc_parameter_place_t * place)
{
  return place != NULL && place->type == (uint8_t)RCLC_PARAMETER_STRING ? place->string : "";
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
