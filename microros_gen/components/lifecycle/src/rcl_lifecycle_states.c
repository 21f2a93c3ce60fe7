/* SPDX-License-Identifier: Apache-2.0 */
/* All labels are constants; a state as a message has the same text, which nothing changes. */
#include "microros/rcl_lifecycle_states.h"

#include "lifecycle_msgs/msg/transition.h"
#include "microros/text.h"
#include "rcl_lifecycle/default_state_machine.h"

/* Positions in rcl_lifecycle_states. */
enum {
  UNKNOWN,
  UNCONFIGURED,
  INACTIVE,
  ACTIVE,
  FINALIZED,
  CONFIGURING,
  CLEANINGUP,
  SHUTTINGDOWN,
  ACTIVATING,
  DEACTIVATING,
  ERRORPROCESSING
};

/* Positions in rcl_lifecycle_transitions: the first one that leaves a state. */
enum {
  AFTER_UNCONFIGURED = 0,
  AFTER_INACTIVE = 2,
  AFTER_ACTIVE = 5,
  AFTER_CONFIGURING = 7,
  AFTER_CLEANINGUP = 10
};
enum { AFTER_SHUTTINGDOWN = 13, AFTER_ACTIVATING = 16, AFTER_DEACTIVATING = 19, AFTER_ERRORPROCESSING = 22 };
enum { OUTCOMES = 3 };

#define TRANSITION_ID(name) lifecycle_msgs__msg__Transition__TRANSITION_##name
#define STATE_ID(name) lifecycle_msgs__msg__State__##name

#define CONFIGURE \
  { \
    "configure", TRANSITION_ID(CONFIGURE), &rcl_lifecycle_states[UNCONFIGURED], \
      &rcl_lifecycle_states[CONFIGURING] \
  }
#define CLEANUP \
  { \
    "cleanup", TRANSITION_ID(CLEANUP), &rcl_lifecycle_states[INACTIVE], &rcl_lifecycle_states[CLEANINGUP] \
  }
#define ACTIVATE \
  { \
    "activate", TRANSITION_ID(ACTIVATE), &rcl_lifecycle_states[INACTIVE], &rcl_lifecycle_states[ACTIVATING] \
  }
#define DEACTIVATE \
  { \
    "deactivate", TRANSITION_ID(DEACTIVATE), &rcl_lifecycle_states[ACTIVE], \
      &rcl_lifecycle_states[DEACTIVATING] \
  }
#define SHUTDOWN(state, id) \
  { \
    "shutdown", (id), &rcl_lifecycle_states[state], &rcl_lifecycle_states[SHUTTINGDOWN] \
  }

/* The three transitions that leave a transition state, by what its callback returned. */
#define SUCCESS(name, start, goal) \
  { \
    "transition_success", TRANSITION_ID(ON_##name##_SUCCESS), &rcl_lifecycle_states[start], \
      &rcl_lifecycle_states[goal] \
  }
#define FAILURE(name, start, goal) \
  { \
    "transition_failure", TRANSITION_ID(ON_##name##_FAILURE), &rcl_lifecycle_states[start], \
      &rcl_lifecycle_states[goal] \
  }
#define ERROR(name, start, goal) \
  { \
    "transition_error", TRANSITION_ID(ON_##name##_ERROR), &rcl_lifecycle_states[start], \
      &rcl_lifecycle_states[goal] \
  }

const rcl_lifecycle_transition_t rcl_lifecycle_transitions[RCL_LIFECYCLE_TRANSITIONS] = {
  CONFIGURE,
  SHUTDOWN(UNCONFIGURED, TRANSITION_ID(UNCONFIGURED_SHUTDOWN)),
  CLEANUP,
  ACTIVATE,
  SHUTDOWN(INACTIVE, TRANSITION_ID(INACTIVE_SHUTDOWN)),
  DEACTIVATE,
  SHUTDOWN(ACTIVE, TRANSITION_ID(ACTIVE_SHUTDOWN)),
  SUCCESS(CONFIGURE, CONFIGURING, INACTIVE),
  FAILURE(CONFIGURE, CONFIGURING, UNCONFIGURED),
  ERROR(CONFIGURE, CONFIGURING, ERRORPROCESSING),
  SUCCESS(CLEANUP, CLEANINGUP, UNCONFIGURED),
  FAILURE(CLEANUP, CLEANINGUP, INACTIVE),
  ERROR(CLEANUP, CLEANINGUP, ERRORPROCESSING),
  SUCCESS(SHUTDOWN, SHUTTINGDOWN, FINALIZED),
  FAILURE(SHUTDOWN, SHUTTINGDOWN, FINALIZED),
  ERROR(SHUTDOWN, SHUTTINGDOWN, ERRORPROCESSING),
  SUCCESS(ACTIVATE, ACTIVATING, ACTIVE),
  FAILURE(ACTIVATE, ACTIVATING, INACTIVE),
  ERROR(ACTIVATE, ACTIVATING, ERRORPROCESSING),
  SUCCESS(DEACTIVATE, DEACTIVATING, INACTIVE),
  FAILURE(DEACTIVATE, DEACTIVATING, ACTIVE),
  ERROR(DEACTIVATE, DEACTIVATING, ERRORPROCESSING),
  SUCCESS(ERROR, ERRORPROCESSING, UNCONFIGURED),
  FAILURE(ERROR, ERRORPROCESSING, FINALIZED),
  ERROR(ERROR, ERRORPROCESSING, FINALIZED),
};

const uint8_t rcl_lifecycle_graph[RCL_LIFECYCLE_TRANSITIONS] = {
  AFTER_UNCONFIGURED,
  AFTER_CONFIGURING,
  AFTER_CONFIGURING + 1,
  AFTER_CONFIGURING + 2,
  AFTER_INACTIVE,
  AFTER_CLEANINGUP,
  AFTER_CLEANINGUP + 1,
  AFTER_CLEANINGUP + 2,
  AFTER_INACTIVE + 1,
  AFTER_ACTIVATING,
  AFTER_ACTIVATING + 1,
  AFTER_ACTIVATING + 2,
  AFTER_ACTIVE,
  AFTER_DEACTIVATING,
  AFTER_DEACTIVATING + 1,
  AFTER_DEACTIVATING + 2,
  AFTER_UNCONFIGURED + 1,
  AFTER_INACTIVE + 2,
  AFTER_ACTIVE + 1,
  AFTER_SHUTTINGDOWN,
  AFTER_SHUTTINGDOWN + 1,
  AFTER_SHUTTINGDOWN + 2,
  AFTER_ERRORPROCESSING,
  AFTER_ERRORPROCESSING + 1,
  AFTER_ERRORPROCESSING + 2,
};

const rcl_lifecycle_state_t rcl_lifecycle_states[RCL_LIFECYCLE_STATES] = {
  {"unknown", STATE_ID(PRIMARY_STATE_UNKNOWN), NULL, 0},
  {"unconfigured", STATE_ID(PRIMARY_STATE_UNCONFIGURED), &rcl_lifecycle_transitions[AFTER_UNCONFIGURED], 2},
  {"inactive", STATE_ID(PRIMARY_STATE_INACTIVE), &rcl_lifecycle_transitions[AFTER_INACTIVE], 3},
  {"active", STATE_ID(PRIMARY_STATE_ACTIVE), &rcl_lifecycle_transitions[AFTER_ACTIVE], 2},
  {"finalized", STATE_ID(PRIMARY_STATE_FINALIZED), NULL, 0},
  {"configuring", STATE_ID(TRANSITION_STATE_CONFIGURING), &rcl_lifecycle_transitions[AFTER_CONFIGURING],
   OUTCOMES},
  {"cleaningup", STATE_ID(TRANSITION_STATE_CLEANINGUP), &rcl_lifecycle_transitions[AFTER_CLEANINGUP],
   OUTCOMES},
  {"shuttingdown", STATE_ID(TRANSITION_STATE_SHUTTINGDOWN), &rcl_lifecycle_transitions[AFTER_SHUTTINGDOWN],
   OUTCOMES},
  {"activating", STATE_ID(TRANSITION_STATE_ACTIVATING), &rcl_lifecycle_transitions[AFTER_ACTIVATING],
   OUTCOMES},
  {"deactivating", STATE_ID(TRANSITION_STATE_DEACTIVATING), &rcl_lifecycle_transitions[AFTER_DEACTIVATING],
   OUTCOMES},
  {"errorprocessing", STATE_ID(TRANSITION_STATE_ERRORPROCESSING),
   &rcl_lifecycle_transitions[AFTER_ERRORPROCESSING], OUTCOMES},
};

/* A string of ROS 2 has a pointer to non-const characters, even in a constant message. */
static char * states_label(const rcl_lifecycle_state_t * state)
{
  union {
    const char * in;
    char * out;
  } pointer;

  pointer.in = state->label;
  return pointer.out;
}

lifecycle_msgs__msg__State rcl_lifecycle_message_of(const rcl_lifecycle_state_t * state)
{
  lifecycle_msgs__msg__State message;

  message.id = state->id;
  message.label.data = states_label(state);
  message.label.size = microros_text_size(state->label);
  message.label.capacity = message.label.size + 1u;
  return message;
}

const char * const rcl_lifecycle_configure_label = "configure";
const char * const rcl_lifecycle_cleanup_label = "cleanup";
const char * const rcl_lifecycle_activate_label = "activate";
const char * const rcl_lifecycle_deactivate_label = "deactivate";
const char * const rcl_lifecycle_shutdown_label = "shutdown";
const char * const rcl_lifecycle_transition_success_label = "transition_success";
const char * const rcl_lifecycle_transition_failure_label = "transition_failure";
const char * const rcl_lifecycle_transition_error_label = "transition_error";
