/* SPDX-License-Identifier: Apache-2.0 */
/* Settings of the kernel without which the library's lock, and the end of another task's wait, would fail at run time. */
#include <nuttx/config.h>

#if !defined(CONFIG_PRIORITY_INHERITANCE)
#error "defconfig: set CONFIG_PRIORITY_INHERITANCE=y"
#endif
/* Otherwise a mutex cannot be recursive: the first function of the library that calls another one would never return. */
#if !defined(CONFIG_PTHREAD_MUTEX_TYPES)
#error "defconfig: set CONFIG_PTHREAD_MUTEX_TYPES=y"
#endif
#if !defined(CONFIG_PIPES)
#error "defconfig: set CONFIG_PIPES=y"
#endif

typedef char port_nuttx_lock_settings_are_complete[1];
