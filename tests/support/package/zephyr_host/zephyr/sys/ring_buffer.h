/* SPDX-License-Identifier: Apache-2.0 */
#ifndef HOST_ZEPHYR_RING_BUFFER_H
#define HOST_ZEPHYR_RING_BUFFER_H

#include <stdbool.h>
#include <stdint.h>

struct ring_buf {
  uint8_t * bytes;
  uint32_t size;
  uint32_t put; /* counts bytes, and wraps */
  uint32_t got;
};

void ring_buf_init(struct ring_buf * ring, uint32_t size, uint8_t * bytes);
uint32_t ring_buf_put(struct ring_buf * ring, const uint8_t * bytes, uint32_t size);
uint32_t ring_buf_get(struct ring_buf * ring, uint8_t * bytes, uint32_t size);
uint32_t ring_buf_get_claim(struct ring_buf * ring, uint8_t ** bytes, uint32_t size);
int ring_buf_get_finish(struct ring_buf * ring, uint32_t size);
bool ring_buf_is_empty(const struct ring_buf * ring);

#endif /* HOST_ZEPHYR_RING_BUFFER_H */
