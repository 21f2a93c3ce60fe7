/* SPDX-License-Identifier: Apache-2.0 */
#include "rcl_lifecycle/default_state_machine.h"

const char * const rcl_lifecycle_configure_label = "configure";
const char * const rcl_lifecycle_cleanup_label = "cleanup";
const char * const rcl_lifecycle_activate_label = "activate";
const char * const rcl_lifecycle_deactivate_label = "deactivate";
const char * const rcl_lifecycle_shutdown_label = "shutdown";
const char * const rcl_lifecycle_transition_success_label = "transition_success";
const char * const rcl_lifecycle_transition_failure_label = "transition_failure";
const char * const rcl_lifecycle_transition_error_label = "transition_error";
