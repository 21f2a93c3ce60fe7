/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/sleep.h"

#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"

#include <string.h>

/* "XRCE" and the version of this layout. */
static const uint32_t retained_magic = 0x58520002u;

/* Plan that both images must have. */
static const char retained_plan[] = MICROROS_PLAN_ID;

static bool retained_has_plan(const rmw_uros_retained_t * retained)
{
  bool same = retained->size == (uint32_t)sizeof(*retained);

  for (size_t i = 0; i < sizeof(retained_plan); ++i) {
    same = same && retained->plan[i] == retained_plan[i];
  }
  return same;
}

static uint32_t retained_check(const rmw_uros_retained_t * retained)
{
  const size_t begin = offsetof(rmw_uros_retained_t, size);

  return xrce_sleep_check(0, &((const uint8_t *)retained)[begin], sizeof(*retained) - begin);
}

/* Waits until the session can be retained; false: nothing has changed. */
static bool sleep_await(xrce_client_t * client, uint32_t timeout_ms)
{
  const uint32_t start = port_time_ms();

  for (;;) {
    xrce_session_pump(client);
    if (xrce_sleep_can_begin(client) && xrce_session_is_sent(&client->session)) {
      return true;
    }
    if (port_time_ms() - start >= timeout_ms) {
      return false;
    }
    microros_pause();
  }
}

static void sleep_write(rmw_uros_retained_t * retained, const xrce_client_t * client)
{
  (void)memset(retained, 0, sizeof(*retained));
  retained->size = (uint32_t)sizeof(*retained);
  (void)memcpy(retained->plan, retained_plan, sizeof(retained->plan));
  (void)memcpy(retained->client, (const uint8_t *)client, sizeof(retained->client));
  (void)memcpy(&retained->xrce_reliable_slots, &xrce_reliable_slots, sizeof(retained->xrce_reliable_slots));
  retained->check = retained_check(retained);
  retained->magic = retained_magic; /* last: until then the memory is invalid */
}

rmw_ret_t rmw_uros_sleep(rmw_context_t * context, rmw_uros_retained_t * retained, uint32_t timeout_ms)
{
  xrce_client_t * client;
  bool is_asleep;

  if (context == NULL || context->impl == NULL || retained == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "context or retained");
  }
  microros_lock();
  client = context->impl;
  is_asleep = sleep_await(client, timeout_ms);
  if (is_asleep) {
    xrce_sleep_begin(client);
    sleep_write(retained, client);
    xrce_session_close(client);
    context->impl = NULL;
  }
  microros_unlock();
  return is_asleep ? RMW_RET_OK : RMW_RET_TIMEOUT;
}

/* What tasks use outside of a session stays as it is. */
static void wake_read(xrce_client_t * client, const rmw_uros_retained_t * retained)
{
  uint8_t * bytes = (uint8_t *)client;

  (void)memcpy(bytes, retained->client, sizeof(retained->client));
  (void)memcpy(&xrce_reliable_slots, &retained->xrce_reliable_slots, sizeof(retained->xrce_reliable_slots));
  client->session.state = (uint8_t)XRCE_CLOSED; /* until rcl_init */
  client->session.transport_open = false;
}

bool rmw_uros_wake(rmw_uros_retained_t * retained)
{
  xrce_client_t * client = rmw_client_instance();
  bool good = false;

  if (retained == NULL) {
    return false;
  }
  microros_lock();
  if (client->session.state == (uint8_t)XRCE_CLOSED) {
    good = retained->magic == retained_magic && retained_has_plan(retained) &&
           retained->check == retained_check(retained);
    retained->magic = 0; /* invalidated: its sequence numbers are used from now on */
  }
  if (good) {
    wake_read(client, retained);
  }
  microros_unlock();
  return good;
}
