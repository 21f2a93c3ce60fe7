/* SPDX-License-Identifier: Apache-2.0 */
/* Value for the planned domain: the node's `domain_id`, or 0. */
#ifndef MICROROS_RMW_DOMAIN_ID_H
#define MICROROS_RMW_DOMAIN_ID_H

#include <stdint.h>

#define RMW_DEFAULT_DOMAIN_ID SIZE_MAX

#endif /* MICROROS_RMW_DOMAIN_ID_H */
