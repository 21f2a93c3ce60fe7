/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/rmw_client_wait.h"
#include "microros/rmw_turn.h"
#include "microros/xrce_client.h"
#include "microros/xrce_local_fresh.h"
#include "microros/xrce_session_spin.h"

/* Not twice in a millisecond while a message of the image waits, which needs no pump. */
void rmw_client_pump(void)
{
  xrce_client_t * client = rmw_client_instance();
  bool is_due;

  /* cppcheck-suppress knownConditionTrueFalse ; without tasks of the application file every task runs the session */
  if (!rmw_turn_pumps()) {
    return;
  }
  microros_lock();
  is_due = !(xrce_local_take_fresh() && client->session.now_ms == port_time_ms());
  microros_unlock();
  /* cppcheck-suppress knownConditionTrueFalse ; without local delivery there is never such a message */
  if (is_due) {
    xrce_session_spin(client);
  }
}
