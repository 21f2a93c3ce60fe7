/* SPDX-License-Identifier: Apache-2.0 */
/* A custom transport, as its functions see it. */
#ifndef MICROROS_UXR_CLIENT_TRANSPORT_H
#define MICROROS_UXR_CLIENT_TRANSPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "uxr/client/util/time.h"

#ifdef __cplusplus
extern "C" {
#endif

struct uxrCustomTransport;

/*
 * Opens the transport again after each close and after a lost session. Returns false if it is not
 * available yet. */
typedef bool (*open_custom_func)(struct uxrCustomTransport * transport);

typedef bool (*close_custom_func)(struct uxrCustomTransport * transport);

/* Returns the number of accepted bytes. Without framing a call is one message, to be accepted whole.
 * `error_code` may be set and is ignored. */
typedef size_t (*write_custom_func)(
  struct uxrCustomTransport * transport, const uint8_t * buffer, size_t length, uint8_t * error_code);

/*
 * Returns the number of bytes written to `buffer`, at most `length`; without framing that is one message.
 * More than `length` counts as none. `timeout` is in milliseconds: 0 with framing, since the next read
 * follows soon, and 1 without, since functions over UDP may wait without end for 0, or never look for a
 * packet.
 */
typedef size_t (*read_custom_func)(
  struct uxrCustomTransport * transport, uint8_t * buffer, size_t length, int timeout, uint8_t * error_code);

/* `args` is the argument of rmw_uros_set_custom_transport. */
typedef struct uxrCustomTransport {
  bool framing;
  open_custom_func open;
  close_custom_func close;
  write_custom_func write;
  read_custom_func read;
  void * args;
} uxrCustomTransport;

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_UXR_CLIENT_TRANSPORT_H */
