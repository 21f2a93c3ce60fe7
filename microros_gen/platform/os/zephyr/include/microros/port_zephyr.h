/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Zephyr 4.0 or newer. A missing setting of prj.conf stops the compiler. All objects are static. The devicetree, the
 * linker script and the build belong to the application.
 */
#ifndef MICROROS_PORT_ZEPHYR_H
#define MICROROS_PORT_ZEPHYR_H

#include <stdint.h>
#include <zephyr/kernel.h>

#ifdef __cplusplus
extern "C" {
#endif

#if !defined(CONFIG_MULTITHREADING)
#error "prj.conf: set CONFIG_MULTITHREADING=y"
#endif
#if !defined(CONFIG_TIMEOUT_64BIT)
#error "prj.conf: set CONFIG_TIMEOUT_64BIT=y"
#endif

/* The priority of the lowest task of the application file; the others follow above it. It may be defined for the compiler. */
#ifndef PORT_ZEPHYR_LOWEST_PRIORITY
#define PORT_ZEPHYR_LOWEST_PRIORITY K_LOWEST_APPLICATION_THREAD_PRIO
#endif

/* Sets the time of day that port_time_epoch_ns returns, in nanoseconds since 1970-01-01 00:00 UTC. From any thread. */
void port_zephyr_epoch_set(int64_t now_ns);

/* Returns the bytes that were received and lost because the library did not read them in time. From any thread. */
uint32_t port_zephyr_serial_lost(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_ZEPHYR_H */
