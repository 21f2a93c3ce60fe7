/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_framing.h"

/* The flag, then what is in front of the payload. */
enum { PAYLOAD_AT = 5 };

uint32_t xrce_framing_arrived(const xrce_framing_t * framing)
{
  return framing->next > PAYLOAD_AT ? framing->next - PAYLOAD_AT : 0u;
}
