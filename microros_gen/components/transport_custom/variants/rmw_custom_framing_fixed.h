/* SPDX-License-Identifier: Apache-2.0 */
/* The application file selects framing. */
#ifndef MICROROS_RMW_CUSTOM_FRAMING_H
#define MICROROS_RMW_CUSTOM_FRAMING_H

#include <stdbool.h>
#include <stddef.h>

#include "microros/error.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether the plan supports this kind of framing; sets the error if not. */
static inline bool rmw_custom_takes_framing(bool framing)
{
  if (framing != (MICROROS_CUSTOM_FRAMING == 1u)) {
    microros_error_set(microros_error_framing, NULL, MICROROS_CUSTOM_FRAMING == 1u ? "false" : "true", 0, 0);
    return false;
  }
  return true;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_CUSTOM_FRAMING_H */
