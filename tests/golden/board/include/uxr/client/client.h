/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The part of this header of the public XRCE client that applications use. Sessions: see
 * rmw_microros/session.h. */
#ifndef MICROROS_UXR_CLIENT_CLIENT_H
#define MICROROS_UXR_CLIENT_CLIENT_H

#include "uxr/client/config.h"
#include "uxr/client/util/time.h"

#endif /* MICROROS_UXR_CLIENT_CLIENT_H */
