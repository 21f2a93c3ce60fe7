/* SPDX-License-Identifier: Apache-2.0 */
/* Reserved names that the C library calls: NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp) */
#define _XOPEN_SOURCE 700
/*
 * What the C library needs for printf: `stdio` of the target file. Linked only if the program prints. There is no heap:
 * newlib's malloc has one block, and returns NULL when it is exhausted. Its three streams need 436 bytes at their first use,
 * the digits of a double (`floats`) up to 3,000 more. picolibc needs no memory.
 */
#include "microros/port_stdio.h"

#include "microros/port_board.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/stat.h>

const char port_stdio_here = 0;

#ifdef __PICOLIBC__

static int stdio_put(char character, FILE * file)
{
  (void)file;
  port_stdio_put((uint8_t)character);
  return (unsigned char)character;
}

static FILE stdio_file = FDEV_SETUP_STREAM(stdio_put, NULL, NULL, _FDEV_SETUP_WRITE);

FILE * const stdout = &stdio_file;
FILE * const stderr = &stdio_file;

#else

#include "microros/port_bare.h"

/* newlib's system calls (The Red Hat newlib C Library, "System Calls"). */
int _write(int file, const char * data, int size);
int _read(int file, char * data, int size);
int _close(int file);
int _lseek(int file, int offset, int whence);
int _fstat(int file, struct stat * status);
int _isatty(int file);
void * _sbrk(ptrdiff_t increment);
void _exit(int status);
int _kill(int process, int number);
int _getpid(void);

/* Only for newlib's streams. A buffer for each would take 1,024 bytes more; without one, each byte is output at once. */
static union {
  uint64_t alignment;
  char bytes[PORT_BOARD_STDIO_MEMORY];
} port_stdio_pool;

#if PORT_BOARD_STDIO_FLOATS
/* newlib-nano only has a weak reference to its formatter of %f, which would not be linked: this is a strong one, in a program
 * that prints. The prototype is internal to newlib; the function is not called from here. */
int _printf_float(void);
static int (*const volatile port_stdio_floats)(void) = _printf_float;
#endif

void * _sbrk(ptrdiff_t increment)
{
  static ptrdiff_t used;
  const ptrdiff_t first = used;

#if PORT_BOARD_STDIO_FLOATS
  (void)port_stdio_floats;
#endif
  if (increment < 0 || increment > (ptrdiff_t)PORT_BOARD_STDIO_MEMORY - used) {
    errno = ENOMEM;
    return (void *)-1;
  }
  used += increment;
  return &port_stdio_pool.bytes[first];
}

int _write(int file, const char * data, int size)
{
  (void)file;
  for (int i = 0; i < size; ++i) {
    port_stdio_put((uint8_t)data[i]);
  }
  return size;
}

int _read(int file, char * data, int size)
{
  (void)file;
  (void)data;
  (void)size;
  return 0; /* the end of the file */
}

int _close(int file)
{
  (void)file;
  return -1;
}

int _lseek(int file, int offset, int whence)
{
  (void)file;
  (void)offset;
  (void)whence;
  return 0;
}

int _fstat(int file, struct stat * status)
{
  (void)file;
  status->st_mode = S_IFCHR;
  return 0;
}

int _isatty(int file)
{
  (void)file;
  return 1;
}

/* For abort() as well. */
void _exit(int status)
{
  (void)status;
  port_bare_reset();
  for (;;) {
    port_bare_wait();
  }
}

int _kill(int process, int number)
{
  (void)process;
  (void)number;
  return -1;
}

int _getpid(void)
{
  return 1;
}

#endif

/* NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp) */
