/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A flag that an interrupt or another task sets without the lock, and the task that waits for it clears. Setting and
 * clearing are one store each, so no set is lost: what is set after it was cleared stays. Internal.
 *
 * Tasks may run on several processors. There a store becomes visible late, unless the compiler orders it: C99 has no words
 * for that, and gcc and clang have these functions. They need no library, because they neither exchange nor add.
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
#ifdef __ATOMIC_SEQ_CST
  __atomic_store_n(flag, true, __ATOMIC_SEQ_CST);
#else
  *flag = true; /* one processor */
#endif
}

/* First clear the flag, then look at what it announces. */
static inline void microros_flag_clear(microros_shared_flag_t * flag)
{
#ifdef __ATOMIC_SEQ_CST
  __atomic_store_n(flag, false, __ATOMIC_SEQ_CST);
#else
  *flag = false;
#endif
}

static inline bool microros_flag_is_set(const microros_shared_flag_t * flag)
{
#ifdef __ATOMIC_SEQ_CST
  return __atomic_load_n(flag, __ATOMIC_SEQ_CST);
#else
  return *flag;
#endif
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_SHARED_FLAG_H */
