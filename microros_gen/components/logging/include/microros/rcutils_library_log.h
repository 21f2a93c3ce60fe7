/* SPDX-License-Identifier: Apache-2.0 */
/* Messages of the library itself. Internal. */
#ifndef MICROROS_RCUTILS_LIBRARY_LOG_H
#define MICROROS_RCUTILS_LIBRARY_LOG_H

#include "microros/xrce_forward.h"
#include "rcutils/logging.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Called in each pump and after the session was closed: logs what has changed since the last call. */
void microros_library_log(const xrce_client_t * client);

/* Logs a text as it is: with the lock, no format may be read, whose work nobody knows. A handler gets it for "%s". */
void microros_log_text(
  const rcutils_log_location_t * location, int severity, const char * name, const char * text);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCUTILS_LIBRARY_LOG_H */
