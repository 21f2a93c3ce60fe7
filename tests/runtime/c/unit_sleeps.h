/* SPDX-License-Identifier: Apache-2.0 */
/* How often the threads of this process went to sleep, as the system counts it. */
#ifndef UNIT_SLEEPS_H
#define UNIT_SLEEPS_H

#include "unit.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 300, LINE_SIZE = 200 };

static unsigned long sleeps_of(const char * thread)
{
  static const char name[] = "voluntary_ctxt_switches:";
  char path[PATH_SIZE];
  char line[LINE_SIZE];
  unsigned long count = 0;
  FILE * file;

  (void)snprintf(path, sizeof(path), "/proc/self/task/%s/status", thread);
  file = fopen(path, "r");
  CHECK(file != NULL);
  while (fgets(line, sizeof(line), file) != NULL) {
    if (strncmp(line, name, strlen(name)) == 0) {
      count = strtoul(&line[strlen(name)], NULL, 10);
    }
  }
  CHECK(fclose(file) == 0);
  return count;
}

static unsigned long sleeps(void)
{
  DIR * threads = opendir("/proc/self/task");
  const struct dirent * thread;
  unsigned long count = 0;

  CHECK(threads != NULL);
  while ((thread = readdir(threads)) != NULL) {
    if (thread->d_name[0] != '.') {
      count += sleeps_of(thread->d_name);
    }
  }
  CHECK(closedir(threads) == 0);
  return count;
}

#endif /* UNIT_SLEEPS_H */
