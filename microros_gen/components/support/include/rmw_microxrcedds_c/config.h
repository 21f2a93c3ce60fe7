/* SPDX-License-Identifier: Apache-2.0 */
/* The choices of the build, under the names that applications test for. */
#ifndef MICROROS_RMW_MICROXRCEDDS_C_CONFIG_H
#define MICROROS_RMW_MICROXRCEDDS_C_CONFIG_H

#include "microros_config.h"

#endif /* MICROROS_RMW_MICROXRCEDDS_C_CONFIG_H */
