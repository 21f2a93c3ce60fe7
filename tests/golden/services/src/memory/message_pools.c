/* SPDX-License-Identifier: Apache-2.0 */
/* The blocks of every pool, each in a separate object, so that the linker drops unused ones. */
#include "microros/message_pools.h"

#include "std_srvs/srv/detail/set_bool__struct.h"

#include <stdbool.h>
#include <stdint.h>

static std_srvs__srv__SetBool_Request std_srvs__srv__SetBool_Request__message_blocks_0[1][1];
static uint8_t std_srvs__srv__SetBool_Request__message_taken_0[1];
static const microros_blocks_t std_srvs__srv__SetBool_Request__message_blocks[] = {
  {(uint8_t *)std_srvs__srv__SetBool_Request__message_blocks_0, std_srvs__srv__SetBool_Request__message_taken_0,
   (uint32_t)sizeof(std_srvs__srv__SetBool_Request__message_blocks_0[0]), 1u},
};
const microros_pool_t microros_pool_std_srvs__srv__SetBool_Request__message = {std_srvs__srv__SetBool_Request__message_blocks, 1u};

static std_srvs__srv__SetBool_Response std_srvs__srv__SetBool_Response__message_blocks_0[1][1];
static uint8_t std_srvs__srv__SetBool_Response__message_taken_0[1];
static const microros_blocks_t std_srvs__srv__SetBool_Response__message_blocks[] = {
  {(uint8_t *)std_srvs__srv__SetBool_Response__message_blocks_0, std_srvs__srv__SetBool_Response__message_taken_0,
   (uint32_t)sizeof(std_srvs__srv__SetBool_Response__message_blocks_0[0]), 1u},
};
const microros_pool_t microros_pool_std_srvs__srv__SetBool_Response__message = {std_srvs__srv__SetBool_Response__message_blocks, 1u};

static char text_blocks_0[1][21];
static uint8_t text_taken_0[1];
static const microros_blocks_t text_blocks[] = {
  {(uint8_t *)text_blocks_0, text_taken_0,
   (uint32_t)sizeof(text_blocks_0[0]), 1u},
};
const microros_pool_t microros_pool_text = {text_blocks, 1u};
