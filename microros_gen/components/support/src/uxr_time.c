/* SPDX-License-Identifier: Apache-2.0 */
#include "uxr/client/util/time.h"

#include "microros/epoch.h"

int64_t uxr_nanos(void)
{
  return microros_epoch_ns();
}

int64_t uxr_millis(void)
{
  return uxr_nanos() / 1000000;
}
