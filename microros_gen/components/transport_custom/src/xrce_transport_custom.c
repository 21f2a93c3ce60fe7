/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_transport.h"

void xrce_plain_close(xrce_transport_t * transport)
{
  (void)transport->custom.close(&transport->custom); /* a failure to close cannot be handled */
}
