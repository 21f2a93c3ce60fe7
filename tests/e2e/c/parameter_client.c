/* SPDX-License-Identifier: Apache-2.0 */
/* A client of parameters: one call for each line of standard input. */
#include "parameter_client_calls.h"

int main(void)
{
  static char line[4096];

  while (fgets(line, sizeof(line), stdin) != NULL) {
    line[strcspn(line, "\n")] = '\0';
    if (strcmp(line, "end") == 0) {
      return close_client() == RCL_RET_OK && rcl_node_fini(&node) == RCL_RET_OK &&
                 rclc_support_fini(&support) == RCL_RET_OK
               ? 0
               : 1;
    }
    calls_run(line);
  }
  return 1;
}
