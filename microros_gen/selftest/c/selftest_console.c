/* SPDX-License-Identifier: Apache-2.0 */
#include "selftest.h"

#include <stdio.h>

/* Each line leaves at once: it is seen even if the next check stops the program. */
void selftest_line(const char * text)
{
  (void)puts(text);
  (void)fflush(stdout);
}
