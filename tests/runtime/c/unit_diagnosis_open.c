/* SPDX-License-Identifier: Apache-2.0 */
/* What is read while the lock is held when the node of a diagnosis is opened again, and what a report sends. */
#include "microros/port.h"
#include "microros/rcl_diagnosis.h"
#include "microros/rcl_diagnosis_hooks.h"
#include "microros/rmw_client.h"
#include "microros/rmw_node.h"
#include "microros/rmw_publisher.h"

#include <stdio.h>

static xrce_client_t client;
static uint32_t reads[MICROROS_DIAGNOSIS_ROWS];
static uint32_t faults;
static bool is_locked;
static bool is_open;
static rmw_publisher_t publisher;

void port_lock(void)
{
  is_locked = true;
}

void port_unlock(void)
{
  is_locked = false;
}

uint32_t port_time_ms(void)
{
  return 1000u;
}

xrce_client_t * rmw_client_instance(void)
{
  return &client;
}

uint16_t rmw_node_index(const rmw_node_t * node)
{
  (void)node;
  return 0;
}

bool rmw_publisher_is_open(const rmw_publisher_t * asked)
{
  (void)asked;
  return is_open;
}

rmw_ret_t rmw_publisher_open(
  const rmw_node_t * node, const rosidl_message_type_support_t * type_support, const char * topic,
  const rmw_qos_profile_t * qos, rmw_publisher_t ** opened)
{
  (void)node;
  (void)type_support;
  (void)topic;
  (void)qos;
  *opened = &publisher;
  is_open = true;
  return RMW_RET_OK;
}

void rmw_publisher_close(rmw_publisher_t * closed)
{
  (void)closed;
  is_open = false;
}

void rcl_diagnosis_times_begin(void)
{
}

uint32_t rcl_diagnosis_count(const xrce_client_t * asked, uint8_t row)
{
  (void)asked;
  if (!is_locked) {
    ++faults;
  }
  ++reads[row];
  return 0;
}

void rcl_diagnosis_measure(void)
{
}

void rcl_diagnosis_age(uint32_t now)
{
  (void)now;
}

uint8_t * xrce_write_reserve(const xrce_endpoint_t * endpoint)
{
  static uint8_t room[1000];

  (void)endpoint;
  return room;
}

uint32_t rcl_diagnosis_encode(const xrce_client_t * asked, uint8_t status, uint8_t * body)
{
  (void)asked;
  (void)body;
  (void)printf("sent %u\n", (unsigned)status);
  return 4;
}

uint16_t xrce_route_unacknowledged(const xrce_client_t * asked)
{
  (void)asked;
  return 0;
}

bool xrce_route_commit(xrce_client_t * asked, bool is_reliable, size_t size)
{
  (void)asked;
  (void)is_reliable;
  (void)size;
  return true;
}

int main(void)
{
  static const xrce_endpoint_t writer = {.client = &client};
  static const rcl_node_t node;

  for (uint32_t i = 0; i < 2u; ++i) {
    if (rcl_diagnosis_open(&node) != RCL_RET_OK) {
      ++faults;
    }
    rcl_diagnosis_close(&node);
  }
  for (uint32_t row = 0; row < (uint32_t)MICROROS_DIAGNOSIS_ROWS; ++row) {
    (void)printf("%s %u\n", rcl_diagnosis_rows[row].key, (unsigned)reads[row]);
  }
  publisher.data = (void *)(uintptr_t)&writer;
  is_locked = true; /* as in each pump */
  if (rcl_diagnosis_open(&node) != RCL_RET_OK) {
    ++faults;
  }
  is_locked = true;
  rcl_diagnosis_step(&client, client.diagnosis.due_ms);
  return (int)faults;
}
