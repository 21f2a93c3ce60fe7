/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_read.h"

const xrce_queue_t xrce_queues[XRCE_RECEIVERS] = {
  {0, 8, 0, 1},
  {8, 4, 1, 4},
  {24, 24, 5, 4},
};
