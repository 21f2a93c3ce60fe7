/* SPDX-License-Identifier: Apache-2.0 */
/* Options of a session, before it starts. */
#ifndef MICROROS_RMW_INIT_OPTIONS_H
#define MICROROS_RMW_INIT_OPTIONS_H

#include <stddef.h>
#include <stdint.h>

#include "microros/rmw_transport_params.h"
#include "rcutils/allocator.h"
#include "rmw/domain_id.h"
#include "rmw/localhost.h"
#include "rmw/macros.h"
#include "rmw/ret_types.h"
#include "rmw/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Contains everything by value: no pool of options can run out, and a copy is an assignment. */
typedef struct rmw_init_options_s {
  uint64_t instance_id;
  const char * implementation_identifier; /* NULL: not initialized */
  size_t domain_id;
  rmw_localhost_only_t localhost_only;
  char * enclave;
  rcutils_allocator_t allocator;
  rmw_uxrce_transport_params_t transport_params;
} rmw_init_options_t;

rmw_init_options_t rmw_get_zero_initialized_init_options(void);

rmw_ret_t rmw_init_options_init(rmw_init_options_t * init_options, rcutils_allocator_t allocator);

rmw_ret_t rmw_init_options_copy(const rmw_init_options_t * src, rmw_init_options_t * dst);

rmw_ret_t rmw_init_options_fini(rmw_init_options_t * init_options);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RMW_INIT_OPTIONS_H */
