/* SPDX-License-Identifier: Apache-2.0 */
/* How much of what the streams had at a moment is still in them, while others go on writing. Internal. */
#ifndef MICROROS_XRCE_MARK_H
#define MICROROS_XRCE_MARK_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Begins as xrce_mark_new; the first look at the streams notes what they hold then. The lock of the library guards it. */
typedef struct xrce_mark_t {
  uint32_t left;    /* numbers of the reliable stream, from `first` on, that are waited for */
  uint32_t session; /* reconnections at the last look */
  uint16_t first;   /* oldest number at the last look */
  uint16_t again;   /* acknowledged numbers that another session would repeat */
  uint16_t queued;  /* waiting best-effort messages, from `head` on */
  uint8_t head;     /* place of the oldest one at the last look */
  bool is_counted;  /* at the last look there was a session, and the numbers were those of the messages */
  bool is_handed;   /* the transport got all of them */
  bool is_sent;     /* and has sent them since */
} xrce_mark_t;

/* Returns a mark that has seen no stream yet. */
static inline xrce_mark_t xrce_mark_new(void)
{
  const xrce_mark_t mark = {UINT32_MAX, 0, 0, 0, UINT16_MAX, 0, false, false, false};

  return mark;
}

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_MARK_H */
