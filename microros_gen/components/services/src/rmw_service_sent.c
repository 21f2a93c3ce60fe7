/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rmw_service.h"

const microros_message_type_t * rmw_service_sent(uint16_t index, const microros_message_type_t * of_handle)
{
  (void)index;
  return of_handle;
}
