/* SPDX-License-Identifier: Apache-2.0 */
/* errors: text. The words of this component; what stands behind % is said in error_text.c. */
#include "microros/error.h"

const char microros_error_executor[] = "executor: %s";
