/* SPDX-License-Identifier: Apache-2.0 */
#ifndef ARDUINO_HOST_NATIVEETHERNET_H
#define ARDUINO_HOST_NATIVEETHERNET_H

#include "IPAddress.h"

struct HostNativeEthernet {
  void begin(uint8_t *, IPAddress)
  {
  }
};

static HostNativeEthernet Ethernet __attribute__((unused));

#endif /* ARDUINO_HOST_NATIVEETHERNET_H */
