/* SPDX-License-Identifier: Apache-2.0 */
/* Messages of a subscription that are taken without a copy. Internal. */
#ifndef MICROROS_RMW_LOAN_H
#define MICROROS_RMW_LOAN_H

#include <stdbool.h>
#include <stddef.h>

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The message of a declared subscription, without memory for its members; NULL: none is taken so. */
typedef struct rmw_loan_t {
  void * message;
  size_t size;
} rmw_loan_t;

/* Of all subscriptions, in their order; from the plan. */
extern const rmw_loan_t rmw_loans[];

/* Returns false also for a closed subscription; `subscription` may be NULL. */
bool rmw_loan_is_possible(const rmw_subscription_t * subscription);

/* Takes the oldest sample; *message then belongs to the application until rmw_loan_return. It stays NULL, with
 * RMW_RET_OK, without a sample or while one is out. */
rmw_ret_t rmw_loan_take(const rmw_subscription_t * subscription, void ** message);

/* Returns false if the message is not out. */
bool rmw_loan_return(const rmw_subscription_t * subscription, const void * message);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_LOAN_H */
