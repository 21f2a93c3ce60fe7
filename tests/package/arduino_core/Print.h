/* SPDX-License-Identifier: Apache-2.0 */
#ifndef PRINT_H
#define PRINT_H

#include <stddef.h>
#include <stdint.h>

class Print
{
public:
  virtual ~Print()
  {
  }
  virtual size_t write(uint8_t value) = 0;
  virtual size_t write(const uint8_t * data, size_t size)
  {
    size_t count = 0;

    while (count < size && write(data[count]) == 1) {
      ++count;
    }
    return count;
  }
  virtual void flush()
  {
  }
};

#endif /* PRINT_H */
