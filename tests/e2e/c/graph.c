/* SPDX-License-Identifier: Apache-2.0 */
/* A node that queries the graph: one call for each line of standard input. */
#include "graph_calls.h"

int main(void)
{
  static char line[256];

  while (fgets(line, sizeof(line), stdin) != NULL) {
    line[strcspn(line, "\n")] = '\0';
    calls_report(calls_call(line));
  }
  return 0;
}
