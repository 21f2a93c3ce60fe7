/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_NUTTX_BOARDCTL_H
#define STAND_IN_NUTTX_BOARDCTL_H

#include <stdint.h>

#define BOARDIOC_UNIQUEID 0xff03

int boardctl(unsigned int command, uintptr_t argument);

#endif /* STAND_IN_NUTTX_BOARDCTL_H */
