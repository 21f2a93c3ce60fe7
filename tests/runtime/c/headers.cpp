// SPDX-License-Identifier: Apache-2.0
// Compiled with `-include` of each public header: every one stands alone, in C++ too.
int main()
{
  return 0;
}
