/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text. The words for samples; what stands behind % is said in error_text.c. */
#include "microros/error.h"

const char microros_error_sample_large[] = "%s: %n bytes have come and %m fit: raise limits%y";
const char microros_error_receiver_reliable[] =
  "%s is reliable here and best_effort in the application file: add qos: {reliability: reliable}%y";
const char microros_error_read_refused[] = "%s: the agent refuses READ_DATA: %a";
