/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text. The hint for a full stream depends on the plan; error_text.c explains the letters after %. */
#include "microros/error.h"

const MICROROS_FLASH char microros_error_stream_full[] =
  "publisher %s: stream full, %n unacknowledged: the agent is away, or raise pools: {history: 5}%y";
