/* SPDX-License-Identifier: Apache-2.0 */
/* No `nodes:` in the application file: subscriptions have no declaration and therefore no storage. */
#include "microros/rmw_subscription.h"

void rmw_subscription_bind(const rmw_subscription_t * subscription, void * ros_message)
{
  (void)subscription;
  (void)ros_message;
}
