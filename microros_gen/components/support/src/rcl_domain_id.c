/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl/domain_id.h"

#include "microros/error.h"

/* cppcheck-suppress constParameter ; the signature is that of ROS 2 */
rcl_ret_t rcl_get_default_domain_id(size_t * domain_id)
{
  if (domain_id == NULL) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "domain_id");
  }
  return RCL_RET_OK;
}
