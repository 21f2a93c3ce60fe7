/* SPDX-License-Identifier: Apache-2.0 */
/* All labels are constants; a state as a message has the same text, which nothing changes. */
#include "microros/rcl_lifecycle_states.h"

#include "lifecycle_msgs/msg/transition.h"

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

/* Positions in rcl_lifecycle_transitions: the first of the three that leave a transition state. */
enum { AFTER_CONFIGURING = 1, AFTER_CLEANINGUP = 5, AFTER_ACTIVATING = 9, AFTER_DEACTIVATING = 13 };
enum { AFTER_SHUTTINGDOWN = 19, AFTER_ERRORPROCESSING = 22, OUTCOMES = 3 };

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
#define SHUTDOWN(state) \
  { \
    "shutdown", TRANSITION_ID(state##_SHUTDOWN), &rcl_lifecycle_states[state], \
      &rcl_lifecycle_states[SHUTTINGDOWN] \
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
  SUCCESS(CONFIGURE, CONFIGURING, INACTIVE),
  FAILURE(CONFIGURE, CONFIGURING, UNCONFIGURED),
  ERROR(CONFIGURE, CONFIGURING, ERRORPROCESSING),
  CLEANUP,
  SUCCESS(CLEANUP, CLEANINGUP, UNCONFIGURED),
  FAILURE(CLEANUP, CLEANINGUP, INACTIVE),
  ERROR(CLEANUP, CLEANINGUP, ERRORPROCESSING),
  ACTIVATE,
  SUCCESS(ACTIVATE, ACTIVATING, ACTIVE),
  FAILURE(ACTIVATE, ACTIVATING, INACTIVE),
  ERROR(ACTIVATE, ACTIVATING, ERRORPROCESSING),
  DEACTIVATE,
  SUCCESS(DEACTIVATE, DEACTIVATING, INACTIVE),
  FAILURE(DEACTIVATE, DEACTIVATING, ACTIVE),
  ERROR(DEACTIVATE, DEACTIVATING, ERRORPROCESSING),
  SHUTDOWN(UNCONFIGURED),
  SHUTDOWN(INACTIVE),
  SHUTDOWN(ACTIVE),
  SUCCESS(SHUTDOWN, SHUTTINGDOWN, FINALIZED),
  FAILURE(SHUTDOWN, SHUTTINGDOWN, FINALIZED),
  ERROR(SHUTDOWN, SHUTTINGDOWN, ERRORPROCESSING),
  SUCCESS(ERROR, ERRORPROCESSING, UNCONFIGURED),
  FAILURE(ERROR, ERRORPROCESSING, FINALIZED),
  ERROR(ERROR, ERRORPROCESSING, FINALIZED),
};

/* Those that leave a primary state do not follow each other above. */
static const rcl_lifecycle_transition_t leaves_unconfigured[] = {CONFIGURE, SHUTDOWN(UNCONFIGURED)};
static const rcl_lifecycle_transition_t leaves_inactive[] = {CLEANUP, ACTIVATE, SHUTDOWN(INACTIVE)};
static const rcl_lifecycle_transition_t leaves_active[] = {DEACTIVATE, SHUTDOWN(ACTIVE)};

const rcl_lifecycle_state_t rcl_lifecycle_states[RCL_LIFECYCLE_STATES] = {
  {"unknown", STATE_ID(PRIMARY_STATE_UNKNOWN), NULL, 0},
  {"unconfigured", STATE_ID(PRIMARY_STATE_UNCONFIGURED), leaves_unconfigured, 2},
  {"inactive", STATE_ID(PRIMARY_STATE_INACTIVE), leaves_inactive, 3},
  {"active", STATE_ID(PRIMARY_STATE_ACTIVE), leaves_active, 2},
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

#define MESSAGE(name, text) \
  { \
    STATE_ID(name), \
    { \
      (text), sizeof(text) - 1u, sizeof(text) \
    } \
  }

static const lifecycle_msgs__msg__State state_messages[RCL_LIFECYCLE_STATES] = {
  MESSAGE(PRIMARY_STATE_UNKNOWN, "unknown"),
  MESSAGE(PRIMARY_STATE_UNCONFIGURED, "unconfigured"),
  MESSAGE(PRIMARY_STATE_INACTIVE, "inactive"),
  MESSAGE(PRIMARY_STATE_ACTIVE, "active"),
  MESSAGE(PRIMARY_STATE_FINALIZED, "finalized"),
  MESSAGE(TRANSITION_STATE_CONFIGURING, "configuring"),
  MESSAGE(TRANSITION_STATE_CLEANINGUP, "cleaningup"),
  MESSAGE(TRANSITION_STATE_SHUTTINGDOWN, "shuttingdown"),
  MESSAGE(TRANSITION_STATE_ACTIVATING, "activating"),
  MESSAGE(TRANSITION_STATE_DEACTIVATING, "deactivating"),
  MESSAGE(TRANSITION_STATE_ERRORPROCESSING, "errorprocessing"),
};

lifecycle_msgs__msg__State rcl_lifecycle_message_of(const rcl_lifecycle_state_t * state)
{
  return state_messages[state - rcl_lifecycle_states];
}
