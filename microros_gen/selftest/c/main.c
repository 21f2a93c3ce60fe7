/* SPDX-License-Identifier: Apache-2.0 */
/* The self-test as a program. Leave this file out if your own main calls selftest_run. */
#include "selftest.h"

int main(void)
{
  return selftest_run() == 0u ? 0 : 1;
}
