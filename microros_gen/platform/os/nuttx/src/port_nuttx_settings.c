/* SPDX-License-Identifier: Apache-2.0 */
/* Settings of the kernel without which something would fail only when it runs. */
#include "microros_config.h"

#include <nuttx/config.h>

#if defined(MICROROS_SEND_BUFFER) && !defined(CONFIG_SERIAL_TERMIOS)
#error "defconfig: set CONFIG_SERIAL_TERMIOS=y"
#endif

typedef char port_nuttx_settings_are_complete[1];
