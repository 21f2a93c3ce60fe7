/* SPDX-License-Identifier: Apache-2.0 */
/* The key of a device that seals its datagrams: 64 hexadecimal digits in the environment. */
#include <microros/seal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool microros_seal_psk(uint32_t client_key, uint8_t psk[MICROROS_SEAL_KEY])
{
  const char * text = getenv("SEAL_PSK");

  (void)client_key;
  if (text == NULL || strlen(text) != 2u * MICROROS_SEAL_KEY) {
    return false;
  }
  for (size_t i = 0; i < MICROROS_SEAL_KEY; ++i) {
    const char digits[3] = {text[2 * i], text[2 * i + 1], '\0'};

    psk[i] = (uint8_t)strtoul(digits, NULL, 16);
  }
  return true;
}
