/* SPDX-License-Identifier: Apache-2.0 */
#ifndef PORT_FAKE_H
#define PORT_FAKE_H

#include <stdbool.h>

/* Acts on a line that is meant for the port; false for any other. */
bool fake_take_line(const char * line);

/* Returns the next line of standard input, without its end. */
char * fake_read_line(void);

#endif /* PORT_FAKE_H */
