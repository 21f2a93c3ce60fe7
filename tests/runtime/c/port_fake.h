/* SPDX-License-Identifier: Apache-2.0 */
#ifndef PORT_FAKE_H
#define PORT_FAKE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Acts on a line that is meant for the port; false for any other. */
bool fake_take_line(const char * line);

/* Returns the next line of standard input, without its end. */
char * fake_read_line(void);

/* What a transport of port_fake_lines.c is made of. */
bool fake_open(const char * host, uint16_t port);
void fake_close(void);
bool fake_send(const uint8_t * data, size_t size);
size_t fake_read(uint8_t * buffer, size_t capacity);
size_t fake_group_read(uint8_t * buffer, size_t capacity);

/* Ends the program where the transport is used without the lock, once that was taken. */
void fake_check_lock(void);

#endif /* PORT_FAKE_H */
