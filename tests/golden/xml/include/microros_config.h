/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The plan as constants. Sizes are bytes, times are milliseconds. Written by microros-gen: change the application file
 * (microros.yaml) instead.
 */
#ifndef MICROROS_CONFIG_H
#define MICROROS_CONFIG_H

/* An application that was compiled against another plan does not link. */
#define MICROROS_PLAN_ID "05b979acb39e7816"
#define rcl_init rcl_init__plan_05b979acb39e7816
#define rclc_support_init rclc_support_init__plan_05b979acb39e7816
#define rclc_support_init_with_options rclc_support_init_with_options__plan_05b979acb39e7816

/* errors: text */
#define MICROROS_ERROR_TEXT_SIZE 160u

/* transport */
#define RMW_UXRCE_TRANSPORT_UDP
#define MICROROS_DISCOVERY_PORT 7400u
#define MICROROS_AGENT_HOST "239.255.0.2"
#define MICROROS_AGENT_PORT 7400u
#define MICROROS_MTU 346u

/* session */
#define MICROROS_CLIENT_KEY port_unique_id()
#define MICROROS_CONNECT_TIMEOUT_MS 1000u
#define MICROROS_CREATE_TIMEOUT_MS 1000u
#define MICROROS_CLOSE_TIMEOUT_MS 300u
#define MICROROS_RETRY_FIRST_MS 100u /* of pauses between attempts, which grow */
#define MICROROS_RETRY_MOST_MS 4000u

/* streams */
#define MICROROS_INPUT_SIZE 64u
#define MICROROS_INPUT_BUFFER_SIZE 64u
#define MICROROS_BEST_EFFORT_SIZE 346u
#define MICROROS_RELIABLE_SLOTS 4u
#define MICROROS_RELIABLE_SLOT_SIZE 44u
#define MICROROS_RELIABLE_FRONT 4u /* of a slot, before the first submessage */
#define MICROROS_HEARTBEAT_PERIOD_MS 100u

/* places */
#define MICROROS_NODES_MAX 1u
#define MICROROS_PUBLISHERS_MAX 2u
#define MICROROS_SUBSCRIPTIONS_MAX 0u
#define MICROROS_SERVICES_MAX 0u
#define MICROROS_CLIENTS_MAX 0u

/* memory */
#define MICROROS_ARENA_SIZE 0u
#define MICROROS_KEPT_MESSAGES 1u /* of each sender: microros/message_pools.h */

#endif /* MICROROS_CONFIG_H */
