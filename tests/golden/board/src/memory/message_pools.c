/* SPDX-License-Identifier: Apache-2.0 */
/* The blocks of every pool, each in a separate object, so that the linker drops unused ones. */
#include "microros/message_pools.h"

#include "std_msgs/msg/detail/header__struct.h"
#include "std_msgs/msg/detail/int32__struct.h"

#include <stdbool.h>
#include <stdint.h>

static std_msgs__msg__Header std_msgs__msg__Header__message_blocks_0[1][1];
static uint8_t std_msgs__msg__Header__message_taken_0[1];
static const microros_blocks_t std_msgs__msg__Header__message_blocks[] = {
  {(uint8_t *)std_msgs__msg__Header__message_blocks_0, std_msgs__msg__Header__message_taken_0,
   (uint32_t)sizeof(std_msgs__msg__Header__message_blocks_0[0]), 1u},
};
const microros_pool_t microros_pool_std_msgs__msg__Header__message = {std_msgs__msg__Header__message_blocks, 1u};

static std_msgs__msg__Int32 std_msgs__msg__Int32__message_blocks_0[1][1];
static uint8_t std_msgs__msg__Int32__message_taken_0[1];
static const microros_blocks_t std_msgs__msg__Int32__message_blocks[] = {
  {(uint8_t *)std_msgs__msg__Int32__message_blocks_0, std_msgs__msg__Int32__message_taken_0,
   (uint32_t)sizeof(std_msgs__msg__Int32__message_blocks_0[0]), 1u},
};
const microros_pool_t microros_pool_std_msgs__msg__Int32__message = {std_msgs__msg__Int32__message_blocks, 1u};

static char text_blocks_0[1][17];
static uint8_t text_taken_0[1];
static const microros_blocks_t text_blocks[] = {
  {(uint8_t *)text_blocks_0, text_taken_0,
   (uint32_t)sizeof(text_blocks_0[0]), 1u},
};
const microros_pool_t microros_pool_text = {text_blocks, 1u};
