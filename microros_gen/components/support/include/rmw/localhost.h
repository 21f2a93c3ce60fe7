/* SPDX-License-Identifier: Apache-2.0 */
/* Reach of DDS: decided by the agent; the value is stored and has no effect here. */
#ifndef MICROROS_RMW_LOCALHOST_H
#define MICROROS_RMW_LOCALHOST_H

typedef enum rmw_localhost_only_e {
  RMW_LOCALHOST_ONLY_DEFAULT = 0,
  RMW_LOCALHOST_ONLY_ENABLED = 1,
  RMW_LOCALHOST_ONLY_DISABLED = 2
} rmw_localhost_only_t;

#endif /* MICROROS_RMW_LOCALHOST_H */
