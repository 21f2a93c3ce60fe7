/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/port.h"
#include "selftest_checks.h"
#include "selftest_report.h"

void selftest_unique_id(void)
{
  const uint32_t id = port_unique_id();

  selftest_true("unique_id", id != 0u, "0", "another number");
  selftest_equal("unique_id_stays", (int64_t)port_unique_id(), (int64_t)id, "in the next call");
}
