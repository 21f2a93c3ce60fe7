/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"

#include <pthread.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static bool lock_make_with(pthread_mutexattr_t * kind, int protocol)
{
  return pthread_mutexattr_setprotocol(kind, protocol) == 0 && pthread_mutex_init(&lock, kind) == 0;
}

/* A system may have no priority inheritance, which the first of these calls or only the second one says. Without memory for
 * a kind, the lock stays as it is, which excludes other tasks as well. */
static void lock_make(void)
{
  pthread_mutexattr_t kind;

  if (pthread_mutexattr_init(&kind) != 0) {
    return;
  }
  if (
    pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE) == 0 &&
    !lock_make_with(&kind, PTHREAD_PRIO_INHERIT)) {
    (void)lock_make_with(&kind, PTHREAD_PRIO_NONE);
  }
  (void)pthread_mutexattr_destroy(&kind);
}

void port_lock(void)
{
  static pthread_once_t once = PTHREAD_ONCE_INIT;

  (void)pthread_once(&once, lock_make);
  (void)pthread_mutex_lock(&lock);
}

void port_unlock(void)
{
  (void)pthread_mutex_unlock(&lock);
}
