/* SPDX-License-Identifier: Apache-2.0 */
/* Labels of transitions. */
#ifndef MICROROS_RCL_LIFECYCLE_DEFAULT_STATE_MACHINE_H
#define MICROROS_RCL_LIFECYCLE_DEFAULT_STATE_MACHINE_H

#include "rcl_lifecycle/data_types.h"
#include "rcl_lifecycle/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const char * const rcl_lifecycle_configure_label;
extern const char * const rcl_lifecycle_cleanup_label;
extern const char * const rcl_lifecycle_activate_label;
extern const char * const rcl_lifecycle_deactivate_label;
extern const char * const rcl_lifecycle_shutdown_label;

/* Those that end a transition state, by what its callback returned. */
extern const char * const rcl_lifecycle_transition_success_label;
extern const char * const rcl_lifecycle_transition_failure_label;
extern const char * const rcl_lifecycle_transition_error_label;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_LIFECYCLE_DEFAULT_STATE_MACHINE_H */
