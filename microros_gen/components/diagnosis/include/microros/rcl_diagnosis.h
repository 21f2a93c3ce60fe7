/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Statuses of a device: each has rows, which are counters, or a check, which is a value with limits, or both. The tables
 * are constants (rcl_diagnosis_declared.c). Everything happens under the lock of the session. Internal.
 */
#ifndef MICROROS_RCL_DIAGNOSIS_H
#define MICROROS_RCL_DIAGNOSIS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/xrce_client.h"
#include "microros_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Levels of diagnostic_msgs/msg/DiagnosticStatus. */
enum { DIAGNOSIS_OK, DIAGNOSIS_WARN, DIAGNOSIS_ERROR, DIAGNOSIS_STALE };

/* The position of no check. */
enum { DIAGNOSIS_NONE = 255 };

/* A bit for each status: a device with many tasks has more than 32. */
#if MICROROS_DIAGNOSIS_STATUSES > 32
typedef uint64_t rcl_diagnosis_bits_t;
#else
typedef uint32_t rcl_diagnosis_bits_t;
#endif

/* A value and from where on it is a warning or an error. */
typedef struct rcl_diagnosis_check_t {
  const char * key;  /* of the value */
  const char * unit; /* NULL: none is shown */
  const char * mode; /* what an error requests; NULL: nothing */
  uint32_t hysteresis;
  uint32_t timeout_ms; /* how long a value holds; 0: forever */
  int32_t warn;
  int32_t error;
  bool has_warn;
  bool has_error;
  bool is_above; /* values above the limits are faults, else those below */
  uint8_t status;
  uint8_t node;
} rcl_diagnosis_check_t;

/* A counter, or a word of a list. */
typedef struct rcl_diagnosis_row_t {
  const char * key;
  const char * const * words; /* NULL: the number itself is shown */
  bool warns;                 /* a change is a warning */
} rcl_diagnosis_row_t;

typedef struct rcl_diagnosis_status_t {
  const char * name;
  uint8_t first_row;
  uint8_t row_count;
  uint8_t check; /* DIAGNOSIS_NONE: it has none */
} rcl_diagnosis_status_t;

/* The last value of a check. */
typedef struct rcl_diagnosis_measure_t {
  uint32_t set_ms;
  int32_t value;
  uint8_t level;
  bool is_set;
  bool is_requested; /* its mode, and the node has not changed to it yet */
  bool is_due;       /* the request is to be tried now */
} rcl_diagnosis_measure_t;

extern const rcl_diagnosis_status_t rcl_diagnosis_statuses[MICROROS_DIAGNOSIS_STATUSES];
extern const rcl_diagnosis_row_t rcl_diagnosis_rows[];
extern const int64_t
  rcl_diagnosis_periods[]; /* of the declared timers, nanoseconds; without any it is not there */
extern const rcl_diagnosis_check_t rcl_diagnosis_checks[];

/* Returns the present number of a row. */
uint32_t rcl_diagnosis_count(const xrce_client_t * client, uint8_t row);

/* Sets the checks of what the library measures by itself. */
void rcl_diagnosis_measure(void);

/* Returns the level of a value, when the one before it had `level`. */
uint8_t rcl_diagnosis_judge(const rcl_diagnosis_check_t * check, int32_t value, uint8_t level);

/* Returns the limit that has been exceeded at this level. */
int32_t rcl_diagnosis_limit(const rcl_diagnosis_check_t * check, uint8_t level);

/* Sets the value of a check; a new level is reported as soon as the stream has room. */
void rcl_diagnosis_set(uint8_t check, int32_t value);

/* Sets it to what the library has measured; negative: nothing could be measured. */
void rcl_diagnosis_note(uint8_t check, int32_t value);

/* Ends values that are too old, and lets requests of modes be tried again. */
void rcl_diagnosis_age(uint32_t now);

/* Returns the last value of a check. */
const rcl_diagnosis_measure_t * rcl_diagnosis_measured(uint8_t check);

/* Returns whether the request of this check's mode is to be tried now; that is noted. `rcl_diagnosis_requested`: it was
 * done. */
bool rcl_diagnosis_take_request(uint8_t check);
void rcl_diagnosis_requested(uint8_t check);

/* Lets statuses be sent, each by its bit. */
void rcl_diagnosis_add(rcl_diagnosis_bits_t statuses);

/* Returns the first row of a status that has changed since it was reported, and whose change is a warning; NULL: none. */
const rcl_diagnosis_row_t * rcl_diagnosis_changed(const xrce_client_t * client, uint8_t status);

/* Encodes a diagnostic_msgs/msg/DiagnosticArray with one status; returns its size, MICROROS_DIAGNOSIS_SIZE at most. */
uint32_t rcl_diagnosis_encode(const xrce_client_t * client, uint8_t status, uint8_t * body);

/* Starts measuring times again; `_busy` returns the share of the time since the last call in which the executor did not
 * wait, percent, -1 if that was too short. */
void rcl_diagnosis_times_begin(void);
int32_t rcl_diagnosis_busy(void);

/* Counters of rounds of callbacks, timers and errors since the start. Times are microseconds. */
uint32_t rcl_diagnosis_rounds(void);
uint32_t rcl_diagnosis_longest_us(void);
uint32_t rcl_diagnosis_missed(void);
uint32_t rcl_diagnosis_overruns(void);
uint32_t rcl_diagnosis_latest_us(void);
uint32_t rcl_diagnosis_timer_us(uint8_t timer); /* of a declared timer: its longest lateness */
uint32_t rcl_diagnosis_errors(void);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCL_DIAGNOSIS_H */
