/* SPDX-License-Identifier: Apache-2.0 */
/* Checks of the port, one function for each group of microros/port.h; selftest_run.c calls those that the library has. */
#ifndef SELFTEST_CHECKS_H
#define SELFTEST_CHECKS_H

#include <stdbool.h>

/* Returns whether time advances: without it, the other checks would not end. */
bool selftest_time(void);

void selftest_steady(void);
void selftest_epoch(void);
void selftest_microseconds(void);
void selftest_sleep(void);
void selftest_wait(void);
void selftest_lock(void);
void selftest_timer(void);
void selftest_timer_wake(void);
void selftest_unique_id(void);
void selftest_tasks(void);
void selftest_task_wake(void);
void selftest_exclusion(void);
void selftest_inheritance(void);
void selftest_stack_peak(void);
void selftest_udp(void);
void selftest_udp_loop(void);
void selftest_udp_link(void);
void selftest_tcp(void);
void selftest_tcp_link(void);
void selftest_multicast(void);
void selftest_serial(void);
void selftest_serial_link(void);
void selftest_canfd(void);
void selftest_canfd_link(void);
void selftest_storage(void);

/* Round trips of the message types (selftest_types.c). */
void selftest_types(void);

#endif /* SELFTEST_CHECKS_H */
