/* SPDX-License-Identifier: Apache-2.0 */
/* Messages of the library itself. Internal. */
#ifndef MICROROS_RCUTILS_LIBRARY_LOG_H
#define MICROROS_RCUTILS_LIBRARY_LOG_H

#include "microros/xrce_forward.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called in each pump and after the session was closed: logs what has changed since the last call. */
void microros_library_log(const xrce_client_t * client);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_LIBRARY_LOG_H */
