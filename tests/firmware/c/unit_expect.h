/* SPDX-License-Identifier: Apache-2.0 */
/* Counts conditions that do not hold, and prints them. */
#ifndef UNIT_EXPECT_H
#define UNIT_EXPECT_H

#include <stdio.h>

static int failures;

#define EXPECT(condition) \
  do { \
    if (!(condition)) { \
      (void)printf("%d: %s\n", __LINE__, #condition); \
      ++failures; \
    } \
  } while (0)

#endif /* UNIT_EXPECT_H */
