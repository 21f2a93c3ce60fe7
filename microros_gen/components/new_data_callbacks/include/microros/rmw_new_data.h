/* SPDX-License-Identifier: Apache-2.0 */
/* Callbacks for what arrives, of any kind of endpoint; internal. */
#ifndef MICROROS_RMW_NEW_DATA_H
#define MICROROS_RMW_NEW_DATA_H

#include "rmw/event_callback_type.h"

#ifdef __cplusplus
extern "C" {
#endif

/* `endpoint` is the data of an open handle of rmw. */
void rmw_new_data_set(const void * endpoint, rmw_event_callback_t callback, const void * user_data);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_NEW_DATA_H */
