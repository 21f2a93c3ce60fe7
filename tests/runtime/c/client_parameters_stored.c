/* SPDX-License-Identifier: Apache-2.0 */
/* client_parameters.c with storage: its calls keep, load and restart, too. */
#define PARAMETERS_STORED
#include "client_parameters.c"
