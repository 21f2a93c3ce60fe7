/* SPDX-License-Identifier: Apache-2.0 */
#ifndef ARDUINO_HOST_UDP_H
#define ARDUINO_HOST_UDP_H

#include "Arduino.h"

class UDP : public Stream
{
public:
  virtual uint8_t begin(uint16_t port) = 0;
  virtual void stop() = 0;
  virtual int beginPacket(IPAddress address, uint16_t port) = 0;
  virtual int endPacket() = 0;
  using Print::write;
  virtual int parsePacket() = 0;
  virtual int read() = 0;
  virtual int read(unsigned char * buffer, size_t size) = 0;
};

#endif /* ARDUINO_HOST_UDP_H */
