/* SPDX-License-Identifier: Apache-2.0 */
/* Settings of the build under the names that applications test. */
#ifndef MICROROS_RMW_MICROXRCEDDS_C_CONFIG_H
#define MICROROS_RMW_MICROXRCEDDS_C_CONFIG_H

#include "microros_config.h"

#endif /* MICROROS_RMW_MICROXRCEDDS_C_CONFIG_H */
