/* SPDX-License-Identifier: Apache-2.0 */
/* At least one declaration has a type with separate limits. */
#include "microros/plan.h"
#include "microros/rmw_service.h"

#include <stddef.h>

const microros_message_type_t * rmw_service_sent(uint16_t index, const microros_message_type_t * of_handle)
{
  const microros_message_type_t * own = microros_declared_endpoints[index].limited;

  return own != NULL ? own : of_handle;
}
