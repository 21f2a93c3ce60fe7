/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of FreeRTOS+TCP that the port calls: for a check of its syntax, not of what it does. */
#ifndef STAND_IN_FREERTOS_IP_H
#define STAND_IN_FREERTOS_IP_H

#include "FreeRTOS.h"

#define ipconfigSOCKET_HAS_USER_WAKE_CALLBACK 1
#define ipconfigUSE_TCP 1
#define pdFREERTOS_ERRNO_EWOULDBLOCK 11
#define pdFREERTOS_ERRNO_ENOSPC 28

BaseType_t FreeRTOS_IsNetworkUp(void);
void FreeRTOS_ReleaseUDPPayloadBuffer(const void * buffer);

#endif /* STAND_IN_FREERTOS_IP_H */
