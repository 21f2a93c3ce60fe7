/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parameters of the application that the application file does not declare, and changes of what it declares. Linked
 * only if the application does either.
 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_string.h"
#include "microros/rclc_parameters.h"

#include <string.h>

static rclc_parameter_own_t own_of_servers[MICROROS_NODES_MAX];

/* Takes a free one, or the one that the server had before it was initialized again. */
static rclc_parameter_own_t * own_take(rclc_parameter_server_t * server)
{
  rclc_parameter_own_t * taken = NULL;

  microros_lock(); /* a server may run in each task */
  for (size_t i = 0; i < MICROROS_NODES_MAX; ++i) {
    rclc_parameter_own_t * own = &own_of_servers[i];

    if (own->server == server || (own->server == NULL && taken == NULL)) {
      taken = own;
    }
  }
  if (taken != NULL) {
    (void)memset(taken, 0, sizeof(*taken));
    taken->server = server;
  }
  microros_unlock();
  return taken;
}

/* Returns the one of a place, or a free one; NULL: all are in use. */
static rclc_parameter_about_t * own_find(
  rclc_parameter_server_t * server, const rclc_parameter_about_t * about, uint32_t * number)
{
  rclc_parameter_own_t * own = server->own != NULL ? server->own : own_take(server);
  rclc_parameter_about_t * found = NULL;

  server->own = own;
  for (size_t i = 0; own != NULL && i < MICROROS_PARAMETERS_MAX; ++i) {
    if (&own->abouts[i] == about || (own->abouts[i].name == NULL && found == NULL)) {
      found = &own->abouts[i];
      *number = (uint32_t)(own - own_of_servers) * MICROROS_PARAMETERS_MAX + (uint32_t)i;
    }
  }
  return found;
}

rclc_parameter_about_t * rclc_parameter_own(
  rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint32_t * number, rcl_ret_t * result)
{
  rclc_parameter_about_t * about = own_find(server, place->about, number);

  if (about == NULL) {
    *result = rclc_parameter_refuse(
      RCL_RET_ERROR, place->about->name, MICROROS_ERROR_WORDS("more servers than nodes"));
    return NULL;
  }
  if (about != place->about) {
    *about = *place->about;
    place->about = about;
  }
  return about;
}

/* Sets the constraints of a description to none. */
static void own_unconstrain(rclc_parameter_about_t * about)
{
  about->range = NULL;
#if MICROROS_PARAMETER_ONE_OF
  about->one_of = NULL;
#endif
#if MICROROS_PARAMETER_RULES > 0u
  about->rules_count = 0;
#endif
#if MICROROS_PARAMETER_STRING_SIZE > 0u
  about->string_most = MICROROS_PARAMETER_STRING_SIZE - 1u;
#endif
#if MICROROS_PARAMETER_ARRAY_SIZE > 0u
  about->array_most = UINT32_MAX;
#endif
}

rclc_parameter_place_t * rclc_parameter_create(
  rclc_parameter_server_t * server, const parameter_text_t * name, uint8_t type)
{
  static char names[PARAMETERS_OWN][MICROROS_PARAMETER_NAME_SIZE];
  uint32_t number = 0;
  rclc_parameter_about_t * about = own_find(server, NULL, &number);

  if (about == NULL || server->count >= MICROROS_PARAMETERS_MAX) {
    return NULL;
  }
  (void)memcpy(names[number], name->data, (size_t)name->size);
  names[number][name->size] = '\0';
  about->name = names[number];
  about->texts = NULL;
  own_unconstrain(about);
  return rclc_parameter_place(server, about, type);
}

/* Set requests that create parameters, where the options of a server allow them. Else none of this is linked. */
static parameter_outcome_t undeclared_check(
  const rclc_parameter_server_t * server, const parameter_requested_t * requested, size_t created)
{
  if (requested->name.size >= (uint32_t)MICROROS_PARAMETER_NAME_SIZE) {
    return PARAMETER_NAME_LONG;
  }
  if (!rclc_parameter_holds(requested->type)) {
    return PARAMETER_UNSUPPORTED;
  }
  if (!rclc_parameter_string_fits(NULL, requested)) {
    return PARAMETER_STRING_LONG;
  }
  if (!rclc_parameter_array_fits(NULL, requested)) {
    return PARAMETER_ARRAY_LONG;
  }
  return server->count + created <= server->max_params ? PARAMETER_SET : PARAMETER_FULL;
}

/* The name is shown from a free place. */
static bool undeclared_accepts(
  rclc_parameter_server_t * server, const parameter_text_t * name, parameter_state_t * new_state)
{
  const rclc_parameter_place_t * place = rclc_parameter_create(server, name, new_state->type);
  bool result = false;

  if (place != NULL) {
    new_state->name = place->about->name;
    result = rclc_parameter_accepts(server, NULL, new_state);
    rclc_parameter_disown(server, place);
  }
  return result;
}

static void undeclared_add(rclc_parameter_server_t * server, const parameter_requested_t * requested)
{
  rclc_parameter_place_t * place = rclc_parameter_create(server, &requested->name, requested->type);

  if (place != NULL) {
    place->dynamic_typing = true;
    rclc_parameter_note(server, place, PARAMETER_EVENT_NEW);
    ++server->count;
  }
}

static void undeclared_retype(rclc_parameter_server_t * server, rclc_parameter_place_t * place, uint8_t type)
{
  uint32_t number = 0;
  rcl_ret_t result = RCL_RET_OK;
  rclc_parameter_about_t * about = rclc_parameter_own(server, place, &number, &result);

  if (about != NULL) {
    own_unconstrain(about);
    place->type = type;
  }
}

const rclc_parameter_undeclared_t rclc_parameter_undeclared = {
  undeclared_check,
  undeclared_accepts,
  undeclared_add,
  undeclared_retype,
  "parameter name '%n' is too long",
  "no place for parameter '%n'"};
