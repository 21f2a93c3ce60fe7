/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw/types.h"

#include <string.h>

rmw_message_info_t rmw_get_zero_initialized_message_info(void)
{
  rmw_message_info_t info;

  (void)memset(&info, 0, sizeof(info));
  return info;
}
