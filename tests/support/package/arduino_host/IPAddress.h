/* SPDX-License-Identifier: Apache-2.0 */
#ifndef ARDUINO_HOST_IPADDRESS_H
#define ARDUINO_HOST_IPADDRESS_H

#include <stdint.h>

class IPAddress
{
public:
  IPAddress() : bytes{0, 0, 0, 0}
  {
  }
  IPAddress(uint8_t a, uint8_t b, uint8_t c, uint8_t d) : bytes{a, b, c, d}
  {
  }
  uint8_t operator[](int index) const
  {
    return bytes[index];
  }

private:
  uint8_t bytes[4];
};

#endif /* ARDUINO_HOST_IPADDRESS_H */
