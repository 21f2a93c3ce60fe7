/* SPDX-License-Identifier: Apache-2.0 */
/* What the texts of a refused handshake name as the other end, without and with a name of the line. */
#include "unit.h"

#include "microros/error.h"
#include "microros/rmw_init_reason.h"
#include "microros/xrce_client.h"

#include <string.h>

static xrce_client_t client;
static const char * named;

/* Replaces that of component support. */
void microros_error_set(
  microros_error_t error, const char * name, const char * detail, uint32_t found, uint32_t fits)
{
  CHECK(strstr(error, "%s") != NULL && detail == NULL && found == MICROROS_CLIENT_KEY && fits == 0u);
  named = name;
}

int main(void)
{
  static const uint8_t faults[] = {XRCE_SEAL_SILENT, XRCE_SEAL_REFUSED, XRCE_SEAL_FORGED};

#ifdef SEAL_HAS_DEVICE
  client.session.transport.device = "/dev/ttyS7";
#endif
  for (size_t i = 0; i < sizeof(faults); ++i) {
    client.session.transport.seal.fault = faults[i];
    CHECK(rmw_init_reason(&client));
    printf("%s\n", named);
  }
  return 0;
}
