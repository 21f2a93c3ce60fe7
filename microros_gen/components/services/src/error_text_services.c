/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text. The words for services and their clients; what stands behind % is said in error_text.c. */
#include "microros/error.h"

const char microros_error_service_undeclared[] =
  "service not declared: add to its node's services:%y: {name: %s, type: %D}";
const char microros_error_service_open[] = "service %s is open already";
const char microros_error_services_full[] = "all %n services are open: set pools: {services: %m}%y";
const char microros_error_client_undeclared[] =
  "client not declared: add to its node's clients:%y: {name: %s, type: %D}";
const char microros_error_client_open[] = "client of %s is open already";
const char microros_error_clients_full[] = "all %n clients are open: set pools: {clients: %m}%y";
const char microros_error_service_qos[] = "service %s: XRCE carries no such QoS: %d";
const char microros_error_service_small[] =
  "%t takes %n bytes and its stream holds %m: declare its service%y";
const char microros_error_service_full[] =
  "service %s: stream full, %n unacknowledged: the agent is away, or raise pools: {history: %m}%y";
const char microros_error_service_session[] = "service %s: no session with the agent";
const char microros_error_service_short[] = "service %s: %n bytes have come, and a head has %m";
const char microros_error_requests_lost[] = "service %s: a session was lost with %n requests under way";
