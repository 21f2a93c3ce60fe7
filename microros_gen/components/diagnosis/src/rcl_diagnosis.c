/* SPDX-License-Identifier: Apache-2.0 */
/* The publisher of /diagnostics, and when each status is sent: a message for each, so that all fit a small stream. */
#include "microros/rcl_diagnosis.h"

#include "microros/cdr.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rcl_diagnosis_hooks.h"
#include "microros/rmw_client.h"
#include "microros/rmw_node.h"
#include "microros/rmw_publisher.h"
#include "microros/xrce_routes.h"
#include "microros/xrce_wire.h"
#include "microros/xrce_write.h"
#include "rmw/qos_profiles.h"

#include <string.h>

enum { DIAGNOSIS_BODY = XRCE_SUBMESSAGE_HEADER + XRCE_OBJECT_PREFIX, DIAGNOSIS_DEPTH = 100 };

/* How long a change is reported, and how often at least: what a new agent sends first reaches no data reader yet. */
enum { DIAGNOSIS_REPORTS = 2, DIAGNOSIS_REPORTS_MS = 5000 };

#define DIAGNOSIS_ALL ((rcl_diagnosis_bits_t)UINT64_MAX)

/* Statuses are encoded when they are sent. */
static const microros_message_type_t diagnosis_message = {
  .dds_type_name = MICROROS_FLASH_NAME("diagnostic_msgs::msg::dds_::DiagnosticArray_"),
  .max_encoded_size = MICROROS_DIAGNOSIS_SIZE};

static const rosidl_message_type_support_t diagnosis_type = {
  .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &diagnosis_message};

static rmw_publisher_t * diagnosis_publisher;
static const rmw_node_t * diagnosis_node;                /* the owner */
static rcl_diagnosis_bits_t diagnosis_waiting;           /* those that are to be sent */
static uint32_t diagnosis_sent[MICROROS_DIAGNOSIS_ROWS]; /* as last reported */
static uint32_t diagnosis_seen[MICROROS_DIAGNOSIS_ROWS]; /* as reported often enough */
/* Since the last change: when the warning about it ends, and how many messages have had it. */
static uint32_t diagnosis_until_ms[MICROROS_DIAGNOSIS_STATUSES];
static uint8_t diagnosis_reported[MICROROS_DIAGNOSIS_STATUSES];

/* Takes the present counters whose change is a warning as reported. Others are not read: the lock is held, and for the
 * one of a stack, the stack itself is read. */
static void diagnosis_begin(const xrce_client_t * client)
{
  for (uint8_t row = 0; row < (uint8_t)MICROROS_DIAGNOSIS_ROWS; ++row) {
    if (rcl_diagnosis_rows[row].warns) {
      diagnosis_seen[row] = rcl_diagnosis_count(client, row);
      diagnosis_sent[row] = diagnosis_seen[row];
    }
  }
}

rcl_ret_t rcl_diagnosis_open(const rcl_node_t * node)
{
  xrce_client_t * client = rmw_client_instance();
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  rcl_ret_t result;

  if (rmw_node_index(node->impl) != 0u || rmw_publisher_is_open(diagnosis_publisher)) {
    return RCL_RET_OK;
  }
  qos.depth = DIAGNOSIS_DEPTH;
  diagnosis_node = node->impl;
  result = rmw_publisher_open(node->impl, &diagnosis_type, "/diagnostics", &qos, &diagnosis_publisher);
  if (result == RCL_RET_OK) {
    microros_lock();
    diagnosis_begin(client);
    (void)memset(diagnosis_reported, 0, sizeof(diagnosis_reported));
    rcl_diagnosis_times_begin();
    if (!client->diagnosis.running) { /* after a sleep the next report stays due */
      client->diagnosis.due_ms = port_time_ms() + MICROROS_DIAGNOSIS_PERIOD_MS;
      client->diagnosis.running = true;
    }
    microros_unlock();
  }
  return result;
}

void rcl_diagnosis_close(const rcl_node_t * node)
{
  if (rmw_publisher_is_open(diagnosis_publisher) && diagnosis_node == node->impl) {
    microros_lock();
    rmw_client_instance()->diagnosis.running = false;
    microros_unlock();
    rmw_publisher_close(diagnosis_publisher);
  }
}

bool rcl_diagnosis_is_running(const xrce_client_t * client)
{
  return client->diagnosis.running && rmw_publisher_is_open(diagnosis_publisher);
}

void rcl_diagnosis_add(rcl_diagnosis_bits_t statuses)
{
  diagnosis_waiting |= statuses;
}

const rcl_diagnosis_row_t * rcl_diagnosis_changed(const xrce_client_t * client, uint8_t status)
{
  const rcl_diagnosis_status_t * about = &rcl_diagnosis_statuses[status];

  for (uint8_t i = 0; i < about->row_count; ++i) {
    const uint8_t row = (uint8_t)(about->first_row + i);

    if (rcl_diagnosis_rows[row].warns && rcl_diagnosis_count(client, row) != diagnosis_seen[row]) {
      return &rcl_diagnosis_rows[row];
    }
  }
  return NULL;
}

/* Notes what a message reports of counters whose change is a warning. Returns whether one differs from the message before.
 * The others are not read a second time: to count that of a stack, the stack itself is read, with the lock held. */
static bool diagnosis_note(const xrce_client_t * client, const rcl_diagnosis_status_t * about)
{
  bool has_changed = false;

  for (uint8_t i = 0; i < about->row_count; ++i) {
    const uint8_t row = (uint8_t)(about->first_row + i);

    if (rcl_diagnosis_rows[row].warns) {
      const uint32_t count = rcl_diagnosis_count(client, row);

      has_changed = has_changed || count != diagnosis_sent[row];
      diagnosis_sent[row] = count;
    }
  }
  return has_changed;
}

/* Counters are compared with what was sent, not with the period before: a loss is reported even if it lasts. */
static void diagnosis_see(const xrce_client_t * client, uint8_t status)
{
  const rcl_diagnosis_status_t * about = &rcl_diagnosis_statuses[status];

  const uint32_t now = port_time_ms();

  if (diagnosis_note(client, about)) {
    diagnosis_reported[status] = 0u;
    diagnosis_until_ms[status] = now + (uint32_t)DIAGNOSIS_REPORTS_MS;
  }
  if (rcl_diagnosis_changed(client, status) != NULL) {
    if (diagnosis_reported[status] < (uint8_t)DIAGNOSIS_REPORTS) {
      diagnosis_reported[status] = (uint8_t)(diagnosis_reported[status] + 1u);
    }
    if (
      diagnosis_reported[status] < (uint8_t)DIAGNOSIS_REPORTS ||
      !xrce_is_due(now, diagnosis_until_ms[status])) {
      return;
    }
  }
  diagnosis_reported[status] = 0u;
  for (uint8_t i = 0; i < about->row_count; ++i) {
    const uint8_t row = (uint8_t)(about->first_row + i);

    diagnosis_seen[row] = diagnosis_sent[row];
  }
}

/* Puts a status into the stream. Returns false without a session or room. */
static bool diagnosis_put(const xrce_client_t * client, uint8_t status)
{
  const xrce_endpoint_t * writer = diagnosis_publisher->data;
  uint8_t * const room = xrce_write_reserve(writer);
  uint32_t size;

  if (room == NULL) {
    return false;
  }
  size = rcl_diagnosis_encode(client, status, &room[DIAGNOSIS_BODY]);
  xrce_put_submessage(
    room, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)((uint32_t)XRCE_OBJECT_PREFIX + size));
  xrce_put_be16(&room[4], XRCE_REQUEST_NONE);
  xrce_put_be16(&room[6], xrce_object_id(writer->index, XRCE_KIND_DATAWRITER));
  diagnosis_see(client, status);
  /* Cannot fail: a reliable stream keeps what it has until it is acknowledged. */
  (void)xrce_route_commit(writer->client, true, (size_t)DIAGNOSIS_BODY + (size_t)size);
  return true;
}

/* Sends waiting statuses in turn; at most half of the slots of the stream have any, the others are the application's. */
static void diagnosis_send(const xrce_client_t * client)
{
  for (uint8_t status = 0; status < (uint8_t)MICROROS_DIAGNOSIS_STATUSES; ++status) {
    const rcl_diagnosis_bits_t bit = (rcl_diagnosis_bits_t)1 << status;

    if ((diagnosis_waiting & bit) != 0u) {
      if (
        xrce_route_unacknowledged(client) >= (MICROROS_RELIABLE_SLOTS + 1u) / 2u ||
        !diagnosis_put(client, status)) {
        return;
      }
      diagnosis_waiting &= ~bit;
    }
  }
}

void rcl_diagnosis_step(xrce_client_t * client, uint32_t now)
{
  if (!rcl_diagnosis_is_running(client)) {
    return;
  }
  if (xrce_is_due(now, client->diagnosis.due_ms)) {
    client->diagnosis.due_ms = now + MICROROS_DIAGNOSIS_PERIOD_MS;
    rcl_diagnosis_measure();
    rcl_diagnosis_age(now);
    rcl_diagnosis_add(DIAGNOSIS_ALL >> ((8u * sizeof(rcl_diagnosis_bits_t)) - MICROROS_DIAGNOSIS_STATUSES));
  }
  diagnosis_send(client);
}
