/* SPDX-License-Identifier: Apache-2.0 */
/* The memory is a file, which the environment variable MICROROS_SHARED names, or /dev/shm/microros. */
#define _POSIX_C_SOURCE 200809L
#include "microros/port_shared.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

/* Returns the descriptor, which the caller closes, of a file of at least `bytes` bytes; -1 without one. posix_fallocate never
 * shortens it: the other image has it in use. */
static int shared_open(size_t bytes)
{
  const char * const name = getenv("MICROROS_SHARED");
  const int file = open(
    name != NULL ? name : "/dev/shm/microros", O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, S_IRUSR | S_IWUSR);

  if (file >= 0 && posix_fallocate(file, 0, (off_t)bytes) != 0) {
    (void)close(file);
    return -1;
  }
  return file;
}

uint32_t * port_shared_region(size_t bytes)
{
  static uint32_t * region;

  if (region == NULL) {
    const int file = shared_open(bytes);

    if (file >= 0) {
      void * const mapped = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);

      (void)close(file); /* the mapping stays */
      region = mapped != MAP_FAILED ? (uint32_t *)mapped : NULL;
    }
  }
  return region;
}

void port_shared_barrier(void)
{
  __atomic_thread_fence(__ATOMIC_SEQ_CST);
}

void port_shared_notify(void)
{
  /* the other process looks every millisecond */
}
