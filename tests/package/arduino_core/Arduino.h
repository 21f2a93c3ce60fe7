/* SPDX-License-Identifier: Apache-2.0 */
/* The part of an Arduino core that the library uses, for programs on the host; also for C, as in a core. */
#ifndef ARDUINO_H
#define ARDUINO_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

unsigned long millis(void);
unsigned long micros(void);
void delay(unsigned long ms);
void yield(void);

#ifdef __cplusplus
} /* extern "C" */

#include "Stream.h"

typedef uint8_t byte;

void setup();
void loop();

/* Standard input and output. */
class HostSerial : public Stream
{
public:
  void begin(unsigned long baud);
  void end();
  int available() override;
  int read() override;
  int peek() override;
  size_t write(uint8_t value) override;
  size_t write(const uint8_t * data, size_t size) override;
};

extern HostSerial Serial;
#endif

#endif /* ARDUINO_H */
