/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "rcl/publisher.h"

/* Nothing to do: every publisher is automatic, and the agent asserts it. Other kinds were refused at
 * creation. */
rcl_ret_t rcl_publisher_assert_liveliness(const rcl_publisher_t * publisher)
{
  if (!rcl_publisher_is_valid(publisher)) {
    return microros_error_refuse(RCL_RET_PUBLISHER_INVALID, "publisher");
  }
  return RCL_RET_OK;
}
