/* SPDX-License-Identifier: Apache-2.0 */
/* One task: whoever publishes does not wait. Internal. */
#ifndef MICROROS_RMW_LOCAL_WAKE_H
#define MICROROS_RMW_LOCAL_WAKE_H

static inline void rmw_local_wake(void)
{
}

#endif /* MICROROS_RMW_LOCAL_WAKE_H */
