/* SPDX-License-Identifier: Apache-2.0 */
/* client_parameters.c with what the application file declares. */
#define PARAMETERS_DECLARED
#include "client_parameters.c"
