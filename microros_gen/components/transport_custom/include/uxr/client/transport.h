/* SPDX-License-Identifier: Apache-2.0 */
/* A transport that the application supplies, as its functions see it. */
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

/* Opens the transport again after each close, and after a lost session. False: it is not there yet. */
typedef bool (*open_custom_func)(struct uxrCustomTransport * transport);

typedef bool (*close_custom_func)(struct uxrCustomTransport * transport);

/* Returns how many bytes were taken. Without framing a call is one message, to be taken whole. `error_code` may be
 * set and is not looked at. */
typedef size_t (*write_custom_func)(
  struct uxrCustomTransport * transport, const uint8_t * buffer, size_t length, uint8_t * error_code);

/*
 * Returns how many bytes it put into `buffer`, `length` at most; without framing that is one message. More than
 * `length` counts as none. `timeout` is in milliseconds: 0 with framing, since bytes are asked for again soon, and
 * 1 without, since functions over UDP take 0 for "for ever" or look for no packet at all.
 */
typedef size_t (*read_custom_func)(
  struct uxrCustomTransport * transport, uint8_t * buffer, size_t length, int timeout, uint8_t * error_code);

/* `args` is what rmw_uros_set_custom_transport was given. */
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
