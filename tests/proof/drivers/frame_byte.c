/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One byte of a serial line, whatever came before: from every state for which frame_is_sound holds, with every byte, to
 * a state for which it holds again. The first state, all zero, is one of them; so are all that follow.
 */
#include "proof.h"

#include "microros/xrce_framing.h"

/*@ predicate frame_is_sound(xrce_framing_t * f, integer capacity) =
      f->next <= 4 || (1 <= f->size <= capacity && f->next <= capacity + 6); */

/*@ ensures frame_is_sound(framing, capacity);
    ensures -1 <= \result <= capacity; */
static int32_t reader_take_raw(xrce_framing_t * framing, uint8_t byte, uint8_t * buffer, size_t capacity);

#include "src/framing/xrce_framing.c"

static xrce_framing_t framing;
static uint8_t buffer[CAPACITY];

size_t xrce_line_room(struct xrce_transport_t * line)
{
  (void)line;
  return SIZE_MAX;
}

bool xrce_line_write(struct xrce_transport_t * line, const uint8_t * data, size_t size)
{
  (void)line;
  (void)data;
  (void)size;
  return true;
}

size_t xrce_line_read(struct xrce_transport_t * line, uint8_t * chunk, size_t capacity)
{
  (void)line;
  (void)chunk;
  (void)capacity;
  return 0;
}

typedef struct range_t {
  uint32_t least;
  uint32_t most;
} range_t;

static void take(range_t next, range_t size, range_t byte)
{
  framing.next = Frama_C_unsigned_int_interval(next.least, next.most);
  framing.size = (uint16_t)Frama_C_unsigned_int_interval(size.least, size.most);
  framing.crc = proof_u16();
  framing.escaped = proof_bool();
  (void)reader_take_raw(
    &framing, (uint8_t)Frama_C_unsigned_int_interval(byte.least, byte.most), buffer, sizeof(buffer));
}

int main(void)
{
  const range_t any_size = {0, UINT16_MAX};
  const range_t any_byte = {0, UINT8_MAX};

  for (uint32_t next = 0; next <= 3u; ++next) {
    take((range_t){next, next}, any_size, any_byte);
  }
  /* The second byte of the size: together they are 0, or not. */
  take((range_t){4, 4}, (range_t){0, UINT8_MAX}, (range_t){0, 0});
  take((range_t){4, 4}, (range_t){UINT8_MAX + 1, UINT16_MAX}, (range_t){0, 0});
  take((range_t){4, 4}, any_size, (range_t){1, UINT8_MAX});
  take((range_t){5, CAPACITY + 5}, (range_t){1, CAPACITY}, any_byte);
  take((range_t){CAPACITY + 6, CAPACITY + 6}, (range_t){1, CAPACITY}, any_byte);
  return 0;
}
