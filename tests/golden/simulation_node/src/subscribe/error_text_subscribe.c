/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text. The words for subscriptions; what stands behind % is said in error_text.c. */
#include "microros/error.h"

const char microros_error_subscription_undeclared[] =
  "subscription not declared: add to its node's subscriptions:%y: {topic: %s, type: %D}";
const char microros_error_subscription_open[] = "subscription %s is open already";
const char microros_error_subscriptions_full[] =
  "all %n subscriptions are open: set pools: {subscriptions: %m}%y";
const char microros_error_subscription_qos[] = "subscription %s: XRCE carries no such QoS: %d";
