/* SPDX-License-Identifier: Apache-2.0 */
/* Whether the application uses the oldest sample of a queue where it is. Internal. */
#ifndef MICROROS_XRCE_LOAN_H
#define MICROROS_XRCE_LOAN_H

#include <stdbool.h>

#include "microros/xrce_client.h"

/* Returns whether the oldest sample is in use: it exists, stays where it is, and cannot be taken. */
static inline bool xrce_loan_is_out(const xrce_client_t * client, const xrce_receiver_t * receiver)
{
  return client->loaned[receiver - client->receivers];
}

/* Called when the receiver has a new owner. */
static inline void xrce_loan_clear(xrce_client_t * client, const xrce_receiver_t * receiver)
{
  client->loaned[receiver - client->receivers] = false;
}

#endif /* MICROROS_XRCE_LOAN_H */
