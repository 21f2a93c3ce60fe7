/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_framing.h"

/* The flag and the header. */
enum { PAYLOAD_AT = 5 };

uint32_t xrce_framing_arrived(const xrce_framing_t * framing)
{
  return framing->next > PAYLOAD_AT ? framing->next - PAYLOAD_AT : 0u;
}
