/* SPDX-License-Identifier: Apache-2.0 */
/* The functions and classes of Arduino that the library and its sketches use, on this computer. */
#ifndef ARDUINO_HOST_H
#define ARDUINO_HOST_H

#include <stddef.h>
#include <stdint.h>

#include "IPAddress.h"

typedef uint8_t byte;

extern "C" {
unsigned long millis(void);
unsigned long micros(void);
void delay(unsigned long ms);
void yield(void);
}

class Print
{
public:
  virtual ~Print()
  {
  }
  virtual size_t write(uint8_t) = 0;
  virtual size_t write(const uint8_t * buffer, size_t size);
};

class Stream : public Print
{
public:
  virtual int available() = 0;
  virtual int read() = 0;
  virtual int peek() = 0;
};

/* A line whose device the variable ARDUINO_LINE names. */
class HostSerial : public Stream
{
public:
  void begin(unsigned long baud);
  size_t write(uint8_t value) override;
  size_t write(const uint8_t * buffer, size_t size) override;
  int available() override;
  int read() override;
  int peek() override;

private:
  int line = -1;
};

extern HostSerial Serial;

void setup();
void loop();

#endif /* ARDUINO_HOST_H */
