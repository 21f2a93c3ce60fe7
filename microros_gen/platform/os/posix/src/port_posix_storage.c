/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Slots are files microros_storage.0, microros_storage.1, … in the folder that the environment variable MICROROS_STORAGE
 * names, or in the current folder.
 */
#define _POSIX_C_SOURCE 200809L
#include "microros/port_storage.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { STORAGE_PATH_SIZE = 1024, STORAGE_DIGITS = 10 };

/* Writes folder, name and number of a slot, at most STORAGE_DIGITS digits; returns false if they do not fit. */
static bool storage_path(char path[STORAGE_PATH_SIZE], const char * folder, uint32_t slot)
{
  static const char name[] = "/microros_storage.";
  static const char digits[] = "0123456789";
  const size_t size = strlen(folder);
  size_t end = size + sizeof(name) - 1u;
  uint32_t divisor = 1;

  if (size + sizeof(name) + STORAGE_DIGITS > STORAGE_PATH_SIZE) {
    return false;
  }
  (void)memcpy(path, folder, size);
  (void)memcpy(&path[size], name, sizeof(name));
  while (slot / divisor >= 10u) {
    divisor *= 10u;
  }
  for (; divisor != 0u; divisor /= 10u) {
    path[end] = digits[slot / divisor % 10u];
    ++end;
  }
  path[end] = '\0';
  return true;
}

/* Returns the descriptor of a slot, which the caller closes; -1 if it cannot be opened. */
static int storage_open(uint32_t slot, int flags)
{
  const char * const folder = getenv("MICROROS_STORAGE");
  const unsigned int wanted = (unsigned int)flags | (unsigned int)O_CLOEXEC;
  char path[STORAGE_PATH_SIZE];

  if (!storage_path(path, folder != NULL ? folder : ".", slot)) {
    return -1;
  }
  return open(path, (int)wanted, S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH);
}

bool port_storage_erase(uint32_t slot)
{
  const int file = storage_open(slot, O_WRONLY | O_CREAT | O_TRUNC);

  const bool is_there = file >= 0 && fsync(file) == 0;

  return file >= 0 && close(file) == 0 && is_there;
}

bool port_storage_write(uint32_t slot, uint32_t offset, const uint8_t * bytes, uint32_t size)
{
  const int file = storage_open(slot, O_WRONLY);
  bool is_there;

  if (file < 0) {
    return false;
  }
  is_there = pwrite(file, bytes, size, (off_t)offset) == (ssize_t)size && fsync(file) == 0;
  return close(file) == 0 && is_there;
}

bool port_storage_read(uint32_t slot, uint32_t offset, uint8_t * bytes, uint32_t size)
{
  const int file = storage_open(slot, O_RDONLY);
  bool is_there;

  if (file < 0) {
    return false;
  }
  is_there = pread(file, bytes, size, (off_t)offset) == (ssize_t)size;
  return close(file) == 0 && is_there;
}
