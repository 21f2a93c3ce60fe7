/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/time_sync.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/rmw_epoch.h"
#include "microros/rmw_epoch_read.h"
#include "microros/xrce_client.h"
#include "microros/xrce_rest.h"
#include "microros/xrce_time_sync.h"
#include "microros/xrce_wire.h"

#include <stddef.h>

/* Returns whether an answer arrived. Waits for a session that is lost or reconnecting. */
static bool sync_wait(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();
  const uint8_t replies = client->time_sync.replies;
  uint32_t due = start; /* when to send the next request */

  for (;;) {
    uint32_t now;
    bool over;

    xrce_session_pump(client);
    if (client->time_sync.replies != replies) {
      return true;
    }
    now = port_time_ms();
    over = now - start >= timeout_ms;
    if (client->session.state == (uint8_t)XRCE_READY && xrce_is_due(now, due) && (!over || due == start)) {
      xrce_turn_borrow();
      xrce_time_sync_request(client);
      xrce_turn_return(client);
      due = now + xrce_session_short_pause(now - start);
    }
    if (over || client->session.state == (uint8_t)XRCE_CLOSED) {
      return false;
    }
    xrce_rest(client);
  }
}

static rmw_ret_t sync_session(int timeout_ms)
{
  const uint32_t timeout = timeout_ms > 0 ? (uint32_t)timeout_ms : 0u;
  xrce_client_t * client = rmw_client_instance();
  bool synchronized;

  if (client->session.state == (uint8_t)XRCE_CLOSED) {
    return microros_error_refuse(RMW_RET_ERROR, "session");
  }
  xrce_time_sync_begin(&client->time_sync);
  synchronized = sync_wait(client, timeout);
  xrce_time_sync_end(&client->time_sync);
  if (!synchronized) {
    microros_error_set(
      microros_error_agent_silent, xrce_transport_name(&client->session.transport), NULL,
      xrce_transport_port(&client->session.transport), timeout);
    return RMW_RET_ERROR;
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_uros_sync_session(const int timeout_ms)
{
  rmw_ret_t result;

  microros_lock();
  result = sync_session(timeout_ms);
  microros_unlock();
  return result;
}

bool rmw_epoch_now(int64_t * epoch_ns)
{
  const xrce_client_t * client = rmw_client_instance();
  int64_t now_ns = 0;
  bool synchronized;

  microros_lock();
  synchronized = client->session.state != XRCE_CLOSED && rmw_epoch_read(client, &now_ns);
  if (synchronized) {
    *epoch_ns = now_ns;
  }
  microros_unlock();
  return synchronized;
}

bool rmw_uros_epoch_synchronized(void)
{
  int64_t ignored;

  return rmw_epoch_now(&ignored);
}

int64_t rmw_uros_epoch_nanos(void)
{
  const xrce_client_t * client = rmw_client_instance();
  int64_t epoch_ns = 0;

  microros_lock();
  if (client->session.state != XRCE_CLOSED) {
    (void)rmw_epoch_read(client, &epoch_ns); /* the time since the start counts, too */
  }
  microros_unlock();
  return epoch_ns;
}

int64_t rmw_uros_epoch_millis(void)
{
  return rmw_uros_epoch_nanos() / 1000000;
}

static const int64_t stamp_ns_per_s = 1000000000;

bool rmw_uros_epoch_stamp(int32_t * sec, uint32_t * nanosec)
{
  int64_t epoch_ns = 0;
  const bool synchronized = rmw_epoch_now(&epoch_ns);
  const int64_t now_ns = synchronized ? epoch_ns : rmw_uros_epoch_nanos();
  const int64_t whole_s = now_ns / stamp_ns_per_s;

  if (sec == NULL || nanosec == NULL || now_ns <= 0 || whole_s > INT32_MAX) {
    return false;
  }
  *sec = (int32_t)whole_s;
  *nanosec = (uint32_t)(now_ns % stamp_ns_per_s);
  return synchronized;
}
