/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_report.h"

/* A lock that is not recursive stops the program here: the name of the check is the last line. */
void selftest_lock(void)
{
  port_lock();
  port_lock();
  port_unlock();
  port_unlock();
  port_lock();
  port_unlock();
  selftest_true("lock_is_recursive", true, "", "");
}
