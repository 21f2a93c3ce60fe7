/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/rmw_init_reason.h"
#include "microros_config.h"

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
  microros_error_set(error, xrce_transport_name(transport), NULL, MICROROS_CLIENT_KEY, 0);
  return true;
}
