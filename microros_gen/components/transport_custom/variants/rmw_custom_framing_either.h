/* SPDX-License-Identifier: Apache-2.0 */
/* The application selects framing at run time. */
#ifndef MICROROS_RMW_CUSTOM_FRAMING_H
#define MICROROS_RMW_CUSTOM_FRAMING_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

static inline bool rmw_custom_takes_framing(bool framing)
{
  (void)framing;
  return true;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_CUSTOM_FRAMING_H */
