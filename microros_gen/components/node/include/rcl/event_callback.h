/* SPDX-License-Identifier: Apache-2.0 */
#ifndef MICROROS_RCL_EVENT_CALLBACK_H
#define MICROROS_RCL_EVENT_CALLBACK_H

#include "rmw/event_callback_type.h"

typedef rmw_event_callback_t rcl_event_callback_t;

#endif /* MICROROS_RCL_EVENT_CALLBACK_H */
