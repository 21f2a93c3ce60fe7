/* SPDX-License-Identifier: Apache-2.0 */
#ifndef IPADDRESS_H
#define IPADDRESS_H

#include <stdint.h>
#include <string.h>

class IPAddress
{
public:
  IPAddress()
  {
  }
  IPAddress(uint8_t a, uint8_t b, uint8_t c, uint8_t d) : octets_{a, b, c, d}
  {
  }
  bool operator==(const IPAddress & other) const
  {
    return memcmp(octets_, other.octets_, sizeof(octets_)) == 0;
  }
  uint8_t operator[](int index) const
  {
    return octets_[index];
  }
  uint8_t & operator[](int index)
  {
    return octets_[index];
  }

private:
  uint8_t octets_[4] = {0, 0, 0, 0};
};

#endif /* IPADDRESS_H */
