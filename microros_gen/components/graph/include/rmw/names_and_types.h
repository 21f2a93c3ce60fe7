/* SPDX-License-Identifier: Apache-2.0 */
/* Names, each with its types. */
#ifndef MICROROS_RMW_NAMES_AND_TYPES_H
#define MICROROS_RMW_NAMES_AND_TYPES_H

#include <stddef.h>

#include "rcutils/allocator.h"
#include "rcutils/types/string_array.h"
#include "rmw/macros.h"
#include "rmw/ret_types.h"
#include "rmw/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct rmw_names_and_types_s {
  rcutils_string_array_t names;
  rcutils_string_array_t * types; /* as many as names */
} rmw_names_and_types_t;

rmw_names_and_types_t rmw_get_zero_initialized_names_and_types(void);

/* Returns RMW_RET_OK if nothing is allocated, otherwise RMW_RET_INVALID_ARGUMENT. */
rmw_ret_t rmw_names_and_types_check_zero(rmw_names_and_types_t * names_and_types);

/*
 * Makes room for `size` names, all NULL and without types. RMW_RET_BAD_ALLOC, with a text, if the allocator
 * has no memory: for the default one `memory: {arena: N}` of the application file. */
rmw_ret_t rmw_names_and_types_init(
  rmw_names_and_types_t * names_and_types, size_t size, rcutils_allocator_t * allocator);

/* Frees all strings and arrays; RMW_RET_OK for what is empty, too. */
rmw_ret_t rmw_names_and_types_fini(rmw_names_and_types_t * names_and_types);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_NAMES_AND_TYPES_H */
