/* SPDX-License-Identifier: Apache-2.0 */
/* Sizes of the plan, under the names of the public XRCE client. */
#ifndef MICROROS_UXR_CLIENT_CONFIG_H
#define MICROROS_UXR_CLIENT_CONFIG_H

#include "microros_config.h"

#define UXR_CONFIG_CUSTOM_TRANSPORT_MTU MICROROS_MTU
#define UXR_CONFIG_SERIAL_TRANSPORT_MTU MICROROS_MTU
#define UXR_CONFIG_TCP_TRANSPORT_MTU MICROROS_MTU
#define UXR_CONFIG_UDP_TRANSPORT_MTU MICROROS_MTU

#endif /* MICROROS_UXR_CLIENT_CONFIG_H */
