/* SPDX-License-Identifier: Apache-2.0 */
/* Bytes of the names of declared services and clients, and of their types, without the NUL. */
#include "microros/xrce_service_sizes.h"

const MICROROS_FLASH xrce_service_sizes_t xrce_service_sizes[XRCE_SERVICES] = {
  {4, 29},
  {4, 29},
};
