/* SPDX-License-Identifier: Apache-2.0 */
#ifndef HARDWARE_WATCHDOG_H
#define HARDWARE_WATCHDOG_H

#include <stdbool.h>
#include <stdint.h>

bool watchdog_caused_reboot(void);
bool watchdog_enable_caused_reboot(void);

#endif /* HARDWARE_WATCHDOG_H */
