/* SPDX-License-Identifier: Apache-2.0 */
#include "rmw_microros/custom_transport.h"

#include "microros/error.h"
#include "microros/rmw_custom_framing.h"
#include "microros/rmw_transport.h"

#include <string.h>

/* Arguments of the last rmw_uros_set_custom_transport; `open` is NULL before. */
static uxrCustomTransport chosen;

static rmw_ret_t custom_set(
  uxrCustomTransport * custom, bool framing, void * args, open_custom_func open_cb,
  close_custom_func close_cb, write_custom_func write_cb, read_custom_func read_cb)
{
  if (open_cb == NULL || close_cb == NULL || write_cb == NULL || read_cb == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "a function of the transport");
  }
  if (!rmw_custom_takes_framing(framing)) {
    return RMW_RET_UNSUPPORTED;
  }
  custom->framing = framing;
  custom->open = open_cb;
  custom->close = close_cb;
  custom->write = write_cb;
  custom->read = read_cb;
  custom->args = args;
  return RMW_RET_OK;
}

rmw_ret_t rmw_uros_set_custom_transport(
  bool framing, void * args, open_custom_func open_cb, close_custom_func close_cb, write_custom_func write_cb,
  read_custom_func read_cb)
{
  return custom_set(&chosen, framing, args, open_cb, close_cb, write_cb, read_cb);
}

rmw_ret_t rmw_uros_options_set_custom_transport(
  bool framing, void * args, open_custom_func open_cb, close_custom_func close_cb, write_custom_func write_cb,
  read_custom_func read_cb, rmw_init_options_t * rmw_options)
{
  if (rmw_options == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "rmw_options");
  }
  return custom_set(
    &rmw_options->transport_params.custom, framing, args, open_cb, close_cb, write_cb, read_cb);
}

bool rmw_transport_prepare(xrce_transport_t * transport, const rmw_uxrce_transport_params_t * params)
{
  (void)memset(transport, 0, sizeof(*transport));
  transport->custom = params->custom.open != NULL ? params->custom : chosen;
  if (transport->custom.open == NULL) {
    microros_error_set(microros_error_custom_unset, NULL, NULL, 0, 0);
    return false;
  }
  return true;
}
