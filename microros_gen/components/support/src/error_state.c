/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error_state.h"

#include "microros/lock.h"

#include <stddef.h>
#include <string.h>

rcutils_error_state_t * microros_error_state(void)
{
  static rcutils_error_state_t state; /* one for all, as in rcutils: its functions take no handle */

  return &state;
}

bool rcutils_error_is_set(void)
{
  return microros_error_state()->message[0] != '\0';
}

const rcutils_error_state_t * rcutils_get_error_state(void)
{
  return rcutils_error_is_set() ? microros_error_state() : NULL;
}

rcutils_error_string_t rcutils_get_error_string(void)
{
  rcutils_error_string_t text;

  microros_lock();
  (void)memcpy(text.str, microros_error_state()->message, sizeof(text.str));
  microros_unlock();
  return text;
}

void rcutils_reset_error(void)
{
  microros_lock();
  microros_error_state()->message[0] = '\0';
  microros_unlock();
}
