/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_NUTTX_SCHED_H
#define STAND_IN_NUTTX_SCHED_H

#define SCHED_PRIORITY_DEFAULT 100

#endif /* STAND_IN_NUTTX_SCHED_H */
