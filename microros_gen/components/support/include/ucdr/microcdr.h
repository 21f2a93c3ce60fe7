/* SPDX-License-Identifier: Apache-2.0 */
/* For transports that include it unnecessarily: encoding is provided by microros/cdr.h and rmw_serialize. */
#ifndef MICROROS_UCDR_MICROCDR_H
#define MICROROS_UCDR_MICROCDR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#endif /* MICROROS_UCDR_MICROCDR_H */
