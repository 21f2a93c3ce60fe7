/* SPDX-License-Identifier: Apache-2.0 */
#ifndef ARDUINO_HOST_ETH_H
#define ARDUINO_HOST_ETH_H

#include "IPAddress.h"

struct HostEthernet {
  bool begin()
  {
    return true;
  }
  bool config(IPAddress, IPAddress, IPAddress)
  {
    return true;
  }
  bool setHostname(const char *)
  {
    return true;
  }
  IPAddress localIP()
  {
    return IPAddress(127, 0, 0, 1);
  }
};

static HostEthernet ETH __attribute__((unused));

#endif /* ARDUINO_HOST_ETH_H */
