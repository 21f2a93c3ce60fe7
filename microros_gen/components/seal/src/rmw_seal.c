/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rmw_init_reason.h"
#include "microros_config.h"

/* The line of a board has no name. */
static const char * seal_place(const xrce_transport_t * transport)
{
  const char * const name = xrce_transport_name(transport);

  /* cppcheck-suppress knownConditionTrueFalse ; a constant for the line of a board */
  return name[0] != '\0' ? name : "the serial line";
}

bool rmw_init_reason(const xrce_client_t * client)
{
  const xrce_transport_t * transport = &client->session.transport;
  microros_error_t error;

  switch (transport->seal.fault) {
    case XRCE_SEAL_NO_KEY:
      error = microros_error_seal_key;
      break;
    case XRCE_SEAL_NO_CRYPTO:
      error = microros_error_seal_crypto;
      break;
    case XRCE_SEAL_SILENT:
      error = microros_error_seal_silent;
      break;
    case XRCE_SEAL_REFUSED:
      error = microros_error_seal_refused;
      break;
    case XRCE_SEAL_FORGED:
      error = microros_error_seal_forged;
      break;
    default:
      return false;
  }
  microros_error_set(error, seal_place(transport), NULL, MICROROS_CLIENT_KEY, 0);
  return true;
}
