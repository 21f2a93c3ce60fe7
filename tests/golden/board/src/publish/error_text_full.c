/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text. What helps when a stream is full follows from the plan; what stands behind % is said in error_text.c. */
#include "microros/error.h"

const char microros_error_stream_full[] =
  "publisher %s: stream full, %n unacknowledged: the agent is away, or raise pools: {history: 5}%y";
