/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A flag that an interrupt or another task sets without the lock, and the task that waits for it clears. Setting and
 * clearing are one store each, so no set is lost: what is set after it was cleared stays. Internal.
 */
#ifndef MICROROS_SHARED_FLAG_H
#define MICROROS_SHARED_FLAG_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef volatile bool microros_shared_flag_t;

/* What the setting task wrote before is visible to who finds the flag set. */
static inline void microros_flag_set(microros_shared_flag_t * flag)
{
  *flag = true;
}

/* First clear the flag, then look at what it announces. */
static inline void microros_flag_clear(microros_shared_flag_t * flag)
{
  *flag = false;
}

static inline bool microros_flag_is_set(const microros_shared_flag_t * flag)
{
  return *flag;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_SHARED_FLAG_H */
