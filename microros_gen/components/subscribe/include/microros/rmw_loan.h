/* SPDX-License-Identifier: Apache-2.0 */
/* Whether messages of a subscription can be taken without a copy: no, unless a component replaces this header.
 * Internal. */
#ifndef MICROROS_RMW_LOAN_H
#define MICROROS_RMW_LOAN_H

#include <stdbool.h>

#include "rmw/types.h"

static inline bool rmw_loan_is_possible(const rmw_subscription_t * subscription)
{
  (void)subscription;
  return false;
}

#endif /* MICROROS_RMW_LOAN_H */
