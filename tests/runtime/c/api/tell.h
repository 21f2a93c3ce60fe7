/* SPDX-License-Identifier: Apache-2.0 */
/* What the programs share that run against ROS 2's librcl and against the generated library. */
#ifndef TELL_H
#define TELL_H

#include <rcl/allocator.h>
#include <rcl/error_handling.h>
#include <stdio.h>
#include <stdlib.h>

static void * heap_allocate(size_t size, void * state)
{
  (void)state;
  return malloc(size);
}
static void heap_deallocate(void * pointer, void * state)
{
  (void)state;
  free(pointer);
}
static void * heap_reallocate(void * pointer, size_t size, void * state)
{
  (void)state;
  return realloc(pointer, size);
}
static void * heap_zero(size_t count, size_t size, void * state)
{
  (void)state;
  return calloc(count, size);
}

static const rcl_allocator_t heap = {heap_allocate, heap_deallocate, heap_reallocate, heap_zero, NULL};

/* Where it goes: the file of the environment's TELL. What librcl's parts say of themselves goes to stdout. */
static inline FILE * tell_file(void)
{
  static FILE * file;

  if (file == NULL) {
    const char * path = getenv("TELL");

    file = path != NULL ? fopen(path, "w") : stdout;
    if (file == NULL || setvbuf(file, NULL, _IOLBF, BUFSIZ) != 0) {
      abort();
    }
  }
  return file;
}

#define SAY(...) (void)fprintf(tell_file(), __VA_ARGS__)

/* The call comes before its line: it may say something, too. */
#define TELL(call) \
  do { \
    const long told = (long)(call); \
    SAY("%s %ld\n", #call, told); \
    rcl_reset_error(); \
  } while (0)

#endif /* TELL_H */
