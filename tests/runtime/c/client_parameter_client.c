/* SPDX-License-Identifier: Apache-2.0 */
/* A client of parameters in the hands of the test: one call for each line of standard input. */
#include "fake_program.h"
#include "fake_steps.h"
#include "parameter_client_calls.h"

int main(void)
{
  return run_calls(calls_run);
}
