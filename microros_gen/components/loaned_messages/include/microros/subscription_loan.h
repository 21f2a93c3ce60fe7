/* SPDX-License-Identifier: Apache-2.0 */
/* Part of rcl/subscription.h. */
#ifndef MICROROS_SUBSCRIPTION_LOAN_H
#define MICROROS_SUBSCRIPTION_LOAN_H

#include "rcl/subscription.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Receives without waiting, and returns the oldest sample as a message whose strings and sequences are in the queue,
 * without a copy: read it, do not enlarge it. It belongs to the library; until it is returned it stays unchanged, no
 * other sample of the subscription can be taken, and where the queue is full newer samples are dropped as by `queue:`,
 * except that this one is kept. `*loaned_message` must be NULL before. `message_info` may be NULL; `allocation` is not
 * used. RCL_RET_SUBSCRIPTION_TAKE_FAILED: no sample, or one is not returned yet. RCL_RET_UNSUPPORTED:
 * rcl_subscription_can_loan_messages is false. RCL_RET_ERROR, with a text, as for rcl_take.
 */
rcl_ret_t rcl_take_loaned_message(
  const rcl_subscription_t * subscription, void ** loaned_message, rmw_message_info_t * message_info,
  rmw_subscription_allocation_t * allocation);

/* Frees the sample: the message is not used any more. RCL_RET_INVALID_ARGUMENT if it was not taken from this
 * subscription or was returned before. A closed subscription has no loans. */
rcl_ret_t rcl_return_loaned_message_from_subscription(
  const rcl_subscription_t * subscription, void * loaned_message);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_SUBSCRIPTION_LOAN_H */
