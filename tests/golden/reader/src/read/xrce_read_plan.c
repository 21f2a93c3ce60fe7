/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_read.h"

const xrce_queue_t xrce_queues[XRCE_RECEIVERS] = {
  {0, 4, 0, 4},
  {16, 3008, 4, 2},
};
