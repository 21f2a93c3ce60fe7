/* SPDX-License-Identifier: Apache-2.0 */
/* Pump and wait of this process's only client; internal. */
#ifndef MICROROS_RMW_CLIENT_WAIT_H
#define MICROROS_RMW_CLIENT_WAIT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Receives and does work that is due, without waiting. */
void rmw_client_pump(void);

/* Rests for at most `timeout_ms`, as xrce_wait does. */
void rmw_client_wait(uint32_t timeout_ms);

/* The same with several tasks, as xrce_wait_news does. */
void rmw_client_wait_news(uint32_t timeout_ms, uint32_t * news);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_CLIENT_WAIT_H */
