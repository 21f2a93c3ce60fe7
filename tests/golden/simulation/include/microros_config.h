/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The plan as constants. Sizes are bytes, times are milliseconds. Written by microros-gen: change the application file
 * (microros.yaml) instead.
 */
#ifndef MICROROS_CONFIG_H
#define MICROROS_CONFIG_H

/* An application that was compiled against another plan does not link. */
#define MICROROS_PLAN_ID "2710d77614c5b82b"
#define rcl_init rcl_init__plan_2710d77614c5b82b
#define rclc_support_init rclc_support_init__plan_2710d77614c5b82b
#define rclc_support_init_with_options rclc_support_init_with_options__plan_2710d77614c5b82b

/* errors: text */
#define MICROROS_ERROR_TEXT_SIZE 160u

/* transport */
#define RMW_UXRCE_TRANSPORT_UDP
#define MICROROS_AGENT_HOST "127.0.0.1"
#define MICROROS_AGENT_PORT 8888u
#define MICROROS_MTU 75u

/* session */
#define MICROROS_CLIENT_KEY port_unique_id()
#define MICROROS_CONNECT_TIMEOUT_MS 1000u
#define MICROROS_CREATE_TIMEOUT_MS 1000u
#define MICROROS_CLOSE_TIMEOUT_MS 300u
#define MICROROS_RETRY_FIRST_MS 100u /* of pauses between attempts, which grow */
#define MICROROS_RETRY_MOST_MS 4000u
#define MICROROS_LIVELINESS_PERIOD_MS 1000u
#define MICROROS_LIVELINESS_WAIT_MS 1000u /* for each answer */
#define MICROROS_LIVELINESS_ATTEMPTS 3u

/* streams */
#define MICROROS_INPUT_SIZE 64u
#define MICROROS_INPUT_BUFFER_SIZE 64u
#define MICROROS_BEST_EFFORT_SIZE 75u
#define MICROROS_RELIABLE_INPUT_SLOTS 1u
#define MICROROS_RELIABLE_INPUT_SLOT_SIZE 64u
#define MICROROS_QUEUE_SLOTS 9u
#define MICROROS_QUEUES_SIZE 120u
#define MICROROS_PRECONFIGURED 0u

/* places */
#define MICROROS_NODES_MAX 1u
#define MICROROS_PUBLISHERS_MAX 0u
#define MICROROS_SUBSCRIPTIONS_MAX 3u
#define MICROROS_SERVICES_MAX 0u
#define MICROROS_CLIENTS_MAX 0u
#define MICROROS_ROS_CLOCKS_MAX 2u
#define MICROROS_JUMP_CALLBACKS_MAX 1u
#define MICROROS_TASKS_SHARE 0u /* several tasks may call the library */
#define MICROROS_EXECUTORS_MAX 1u
#define MICROROS_HANDLES_MAX 3u /* of each executor */
#define MICROROS_GUARD_CONDITIONS_MAX 0u
#define MICROROS_WAIT_SETS_MAX 1u
#define MICROROS_TIMERS_MAX 1u

/* memory */
#define MICROROS_ARENA_SIZE 0u

#endif /* MICROROS_CONFIG_H */
