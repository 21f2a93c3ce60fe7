/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Parameters of the application file whose values are in a memory that behaves as flash: a unit is written once after it
 * was erased. It is outside of what start-up code initializes. A parameter resets the processor.
 * `storage_report` has how often the firmware started, the result of loading, and what did not pass.
 */
#include <microros/port_storage.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_parameter/declared_parameters.h>
#include <rclc_parameter/parameter_storage.h>

#include <string.h>

enum { SLOTS = 2, SLOT_SIZE = 4096, UNIT = 8, ERASED = 0xff, ROUNDS_TO_REPLY = 100 };
enum { SET_RESET = 0x05fa0004 };

typedef struct flash_t {
  uint8_t slots[SLOTS][SLOT_SIZE];
  uint32_t starts; /* since the memory was new, which is zero */
} flash_t;

static flash_t * const flash = (flash_t *)FLASH_ADDRESS;

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rclc_parameter_server_t server;
static arm_device_parameters_t values;

volatile uint32_t storage_report[3];

static bool flash_has(uint32_t slot, uint32_t offset, uint32_t size)
{
  return slot < (uint32_t)SLOTS && offset <= (uint32_t)SLOT_SIZE && size <= (uint32_t)SLOT_SIZE - offset;
}

bool port_storage_erase(uint32_t slot)
{
  if (!flash_has(slot, 0, 0)) {
    return false;
  }
  (void)memset(flash->slots[slot], ERASED, SLOT_SIZE);
  return true;
}

bool port_storage_write(uint32_t slot, uint32_t offset, const uint8_t * bytes, uint32_t size)
{
  if (!flash_has(slot, offset, size) || offset % (uint32_t)UNIT != 0u) {
    return false;
  }
  for (uint32_t i = 0; i < size; ++i) {
    if (flash->slots[slot][offset + i] != (uint8_t)ERASED) {
      return false;
    }
  }
  (void)memcpy(&flash->slots[slot][offset], bytes, size);
  return true;
}

bool port_storage_read(uint32_t slot, uint32_t offset, uint8_t * bytes, uint32_t size)
{
  if (!flash_has(slot, offset, size)) {
    return false;
  }
  (void)memcpy(bytes, &flash->slots[slot][offset], size);
  return true;
}

static rcl_ret_t open_server(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  size_t skipped = 0;
  rcl_ret_t result = rclc_support_init(&support, 0, NULL, &allocator);

  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "device", "arm", &support);
  }
  if (result == RCL_RET_OK) {
    result = rclc_parameter_server_init_default(&server, &node);
  }
  if (result == RCL_RET_OK) {
    result = arm_device_parameters_declare(&server);
  }
  if (result == RCL_RET_OK) {
    result = rclc_parameter_storage_load(&server, 0, &skipped);
    storage_report[1] = (uint32_t)result;
    storage_report[2] = (uint32_t)skipped;
  }
  if (result == RCL_RET_OK) {
    result =
      rclc_executor_init(&executor, &support.context, RCLC_EXECUTOR_PARAMETER_SERVER_HANDLES, &allocator);
  }
  return result == RCL_RET_OK ? rclc_executor_add_parameter_server(&executor, &server, NULL) : result;
}

/* Sends what is due, and resets. */
static void restart(void)
{
  for (uint32_t i = 0; i < (uint32_t)ROUNDS_TO_REPLY; ++i) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(5));
  }
  *(volatile uint32_t *)RESET_ADDRESS = SET_RESET;
  for (;;) {
  }
}

int main(void)
{
  ++flash->starts;
  storage_report[0] = flash->starts;
  if (open_server() != RCL_RET_OK) {
    return 1;
  }
  for (;;) {
    (void)rclc_executor_spin_some(&executor, RCL_MS_TO_NS(10));
    if (arm_device_parameters_update(&values, &server)) {
      const bool restarts = values.restart;

      if (
        (restarts && rclc_parameter_set_bool(&server, "restart", false) != RCL_RET_OK) ||
        rclc_parameter_storage_save(&server, 0) != RCL_RET_OK) {
        return 1;
      }
      if (restarts) {
        restart();
      }
    }
  }
}
