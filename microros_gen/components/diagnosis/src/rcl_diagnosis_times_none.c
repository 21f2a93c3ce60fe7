/* SPDX-License-Identifier: Apache-2.0 */
/* No executor, or several tasks, whose waits cannot be told apart: nothing is measured. */
#include "microros/rcl_diagnosis.h"

void rcl_diagnosis_times_begin(void)
{
}
