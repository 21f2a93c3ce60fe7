/* SPDX-License-Identifier: Apache-2.0 */
#ifndef STAND_IN_PICO_MUTEX_H
#define STAND_IN_PICO_MUTEX_H

typedef struct {
  int depth;
} recursive_mutex_t;

#define auto_init_recursive_mutex(name) static recursive_mutex_t name

void recursive_mutex_enter_blocking(recursive_mutex_t * mutex);
void recursive_mutex_exit(recursive_mutex_t * mutex);

#endif /* STAND_IN_PICO_MUTEX_H */
