/* SPDX-License-Identifier: Apache-2.0 */
/* What the package `pico` calls of the Pico SDK, on this computer. */
#include "mutex.h"
#include "stdio.h"
#include "time.h"
#include "unique_id.h"
