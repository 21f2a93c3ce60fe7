/* SPDX-License-Identifier: Apache-2.0 */
#ifndef CLIENT_H
#define CLIENT_H

#include "IPAddress.h"
#include "Stream.h"

class Client : public Stream
{
public:
  virtual int connect(IPAddress ip, uint16_t port) = 0;
  using Print::write;
  using Stream::read;
  virtual int read(uint8_t * buffer, size_t size) = 0;
  virtual void stop() = 0;
  virtual uint8_t connected() = 0;
};

#endif /* CLIENT_H */
