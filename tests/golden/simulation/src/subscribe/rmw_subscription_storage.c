/* SPDX-License-Identifier: Apache-2.0 */
/* Message storage of the declared subscriptions. */
#include "microros/rmw_subscription.h"
#include "std_msgs/msg/detail/string__storage.h"

#include <stddef.h>

typedef void (*subscription_bind_t)(void * ros_message);

/* /said */
static void subscription_bind_2(void * ros_message)
{
  static std_msgs__msg__String__Storage storage;
  std_msgs__msg__String * message = ros_message;

  if (
    message->data.capacity <= 1u) {
    std_msgs__msg__String__bind(message, &storage);
  }
}

void rmw_subscription_bind(const rmw_subscription_t * subscription, void * ros_message)
{
  static const subscription_bind_t binds[MICROROS_SUBSCRIPTIONS_MAX] = {
    NULL,
    NULL,
    subscription_bind_2,
  };
  const xrce_endpoint_t * endpoint = subscription->data;
  const subscription_bind_t bind = binds[endpoint->index - MICROROS_PUBLISHERS_MAX];

  if (bind != NULL) {
    bind(ros_message);
  }
}
