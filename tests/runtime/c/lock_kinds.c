/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The lock of POSIX on systems without priority inheritance: lock_kinds any|none|late. It is refused at once (`none`) or with the
 * mutex (`late`). Two tasks count, each under the lock, which it takes twice. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static bool is_any;
static bool is_none;

static int fake_setprotocol(pthread_mutexattr_t * kind, int protocol)
{
  return protocol == PTHREAD_PRIO_INHERIT && is_none ? ENOTSUP
                                                     : pthread_mutexattr_setprotocol(kind, protocol);
}

static int fake_init(pthread_mutex_t * mutex, const pthread_mutexattr_t * kind)
{
  int protocol = PTHREAD_PRIO_NONE;

  (void)pthread_mutexattr_getprotocol(kind, &protocol);
  return protocol == PTHREAD_PRIO_INHERIT && !is_any ? ENOTSUP : pthread_mutex_init(mutex, kind);
}

#define pthread_mutexattr_setprotocol fake_setprotocol
#define pthread_mutex_init fake_init
#include "lock_source.c"

enum { TURNS = 20000 };

static volatile unsigned count;

static void * add(void * context)
{
  (void)context;
  for (unsigned i = 0; i < (unsigned)TURNS; ++i) {
    port_lock();
    port_lock();
    count = count + 1u;
    port_unlock();
    port_unlock();
  }
  return NULL;
}

int main(int argc, char ** argv)
{
  pthread_t task;

  if (argc != 2) {
    return 2;
  }
  is_any = strcmp(argv[1], "any") == 0;
  is_none = strcmp(argv[1], "none") == 0;
  if (pthread_create(&task, NULL, add, NULL) != 0) {
    return 3;
  }
  (void)add(NULL);
  if (pthread_join(task, NULL) != 0) {
    return 4;
  }
  printf("%u\n", count);
  return 0;
}
