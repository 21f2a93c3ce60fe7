/* SPDX-License-Identifier: Apache-2.0 */
/* Settings of the kernel without which something would fail only when it runs. */
#include "microros_config.h"

#include <nuttx/config.h>

#if defined(MICROROS_TASKS) && !defined(CONFIG_PRIORITY_INHERITANCE)
#error "defconfig: set CONFIG_PRIORITY_INHERITANCE=y"
#endif
/* Otherwise a mutex cannot be recursive: the first function of the library that calls another one would never return. */
#if defined(MICROROS_TASKS) && !defined(CONFIG_PTHREAD_MUTEX_TYPES)
#error "defconfig: set CONFIG_PTHREAD_MUTEX_TYPES=y"
#endif
#if defined(MICROROS_TASKS) && !defined(CONFIG_PIPES)
#error "defconfig: set CONFIG_PIPES=y"
#endif
#if defined(MICROROS_SEND_BUFFER) && !defined(CONFIG_SERIAL_TERMIOS)
#error "defconfig: set CONFIG_SERIAL_TERMIOS=y"
#endif

typedef char port_nuttx_settings_are_complete[1];
