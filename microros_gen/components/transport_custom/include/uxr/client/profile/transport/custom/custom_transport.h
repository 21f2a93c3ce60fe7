/* SPDX-License-Identifier: Apache-2.0 */
/* Another name of uxr/client/transport.h. */
#ifndef MICROROS_UXR_CLIENT_PROFILE_TRANSPORT_CUSTOM_TRANSPORT_H
#define MICROROS_UXR_CLIENT_PROFILE_TRANSPORT_CUSTOM_TRANSPORT_H

#include "uxr/client/config.h"
#include "uxr/client/transport.h"

#endif /* MICROROS_UXR_CLIENT_PROFILE_TRANSPORT_CUSTOM_TRANSPORT_H */
