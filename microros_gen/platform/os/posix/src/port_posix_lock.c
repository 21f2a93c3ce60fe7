/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port.h"

#include <pthread.h>

static pthread_mutex_t lock;

static void lock_make(void)
{
  pthread_mutexattr_t kind;

  (void)pthread_mutexattr_init(&kind); /* these calls need no memory, and POSIX defines this kind */
  (void)pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE);
  (void)pthread_mutexattr_setprotocol(&kind, PTHREAD_PRIO_INHERIT);
  (void)pthread_mutex_init(&lock, &kind);
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
