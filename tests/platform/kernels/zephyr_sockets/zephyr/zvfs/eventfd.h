/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_ZEPHYR_EVENTFD_H
#define STAND_IN_ZEPHYR_EVENTFD_H

#include <stdint.h>

#define ZVFS_EFD_NONBLOCK 0x4000

typedef uint64_t zvfs_eventfd_t;

int zvfs_eventfd(unsigned int initial, int flags);
int zvfs_eventfd_read(int descriptor, zvfs_eventfd_t * value);
int zvfs_eventfd_write(int descriptor, zvfs_eventfd_t value);

#endif /* STAND_IN_ZEPHYR_EVENTFD_H */
