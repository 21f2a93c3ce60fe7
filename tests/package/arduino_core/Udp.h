/* SPDX-License-Identifier: Apache-2.0 */
#ifndef UDP_H
#define UDP_H

#include "IPAddress.h"
#include "Stream.h"

class UDP : public Stream
{
public:
  virtual uint8_t begin(uint16_t port) = 0;
  virtual void stop() = 0;
  virtual int beginPacket(IPAddress ip, uint16_t port) = 0;
  virtual int endPacket() = 0;
  using Print::write;
  using Stream::read;
  virtual int parsePacket() = 0;
  virtual int read(unsigned char * buffer, size_t size) = 0;
  virtual IPAddress remoteIP() = 0;
  virtual uint16_t remotePort() = 0;
};

#endif /* UDP_H */
