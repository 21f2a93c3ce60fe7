/* SPDX-License-Identifier: Apache-2.0 */
/* Callback for events; `number_of_events` have occurred since the last call. */
#ifndef MICROROS_RMW_EVENT_CALLBACK_TYPE_H
#define MICROROS_RMW_EVENT_CALLBACK_TYPE_H

#include <stddef.h>

typedef void (*rmw_event_callback_t)(const void * user_data, size_t number_of_events);

#endif /* MICROROS_RMW_EVENT_CALLBACK_TYPE_H */
