/* SPDX-License-Identifier: Apache-2.0 */
/* The domain of a node that names none. */
#ifndef MICROROS_RCL_DOMAIN_ID_H
#define MICROROS_RCL_DOMAIN_ID_H

#include "rmw/domain_id.h"

#define RCL_DEFAULT_DOMAIN_ID RMW_DEFAULT_DOMAIN_ID

#endif /* MICROROS_RCL_DOMAIN_ID_H */
