/* SPDX-License-Identifier: Apache-2.0 */
/* A node that queries the graph in the hands of the test: one call for each line of standard input. */
#include "fake_program.h"
#include "fake_steps.h"
#include "graph_calls.h"

static void work(char * line)
{
  calls_report(calls_call(line));
}

int main(void)
{
  return run_calls(work);
}
