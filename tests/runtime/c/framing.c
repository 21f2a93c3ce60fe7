/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The framing over a line in memory, told by stdin what to do:
 *   open CAPACITY PIECE   a new reader; the line gives at most PIECE bytes a read
 *   feed HEX              these bytes arrive; prints `got HEX` and `bad` in their order, then `end`
 *   room N                the line takes N more bytes, and says so
 *   silent N              the same, and does not say it before
 *   send HEX              prints `sent HEX` or `failed HEX` with what the line took
 */
#include "microros/xrce_framing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_SIZE = 400000, UNTOUCHED = 0xee };

struct xrce_transport_t {
  uint8_t in[LINE_SIZE];
  size_t in_size;
  size_t in_used;
  size_t piece;
  uint8_t out[LINE_SIZE];
  size_t out_size;
  size_t room;
  bool tells;
};

static struct xrce_transport_t line;
static uint8_t bytes[LINE_SIZE];
static char text[2 * LINE_SIZE + 16];

size_t xrce_line_room(struct xrce_transport_t * to)
{
  return to->tells ? to->room : SIZE_MAX;
}

bool xrce_line_write(struct xrce_transport_t * to, const uint8_t * data, size_t size)
{
  const size_t taken = size < to->room ? size : to->room;

  if (size > XRCE_FRAMING_CHUNK) {
    abort();
  }
  memcpy(&to->out[to->out_size], data, taken);
  to->out_size += taken;
  to->room -= taken;
  return taken == size;
}

size_t xrce_line_read(struct xrce_transport_t * from, uint8_t * buffer, size_t capacity)
{
  size_t size = from->in_size - from->in_used;

  size = size < from->piece ? size : from->piece;
  size = size < capacity ? size : capacity;
  memcpy(buffer, &from->in[from->in_used], size);
  from->in_used += size;
  return size;
}

static size_t from_hex(const char * digits)
{
  size_t size = 0;

  while (digits[2u * size] > ' ' && digits[2u * size + 1u] > ' ') {
    const char pair[3] = {digits[2u * size], digits[2u * size + 1u], '\0'};

    bytes[size] = (uint8_t)strtoul(pair, NULL, 16);
    ++size;
  }
  return size;
}

static void print(const char * word, const uint8_t * data, size_t size)
{
  printf("%s ", word);
  for (size_t i = 0; i < size; ++i) {
    printf("%02x", data[i]);
  }
  printf("\n");
}

/* A frame on its way has touched no more of the buffer than the reader says. */
static void check_untouched(const xrce_framing_t * framing, const uint8_t * buffer, size_t capacity)
{
  for (size_t i = xrce_framing_arrived(framing); i < capacity; ++i) {
    if (buffer[i] != UNTOUCHED) {
      abort();
    }
  }
}

static void feed(xrce_framing_t * framing, uint8_t * buffer, size_t capacity, size_t size)
{
  memcpy(line.in, bytes, size);
  line.in_size = size;
  line.in_used = 0;
  while (line.in_used < line.in_size || framing->used < framing->held) {
    const int32_t got = xrce_framing_receive(framing, &line, buffer, capacity);

    if (got > 0) {
      print("got", buffer, (size_t)got);
    } else if (got < 0) {
      printf("bad\n");
    } else {
      if (framing->used != framing->held) {
        abort(); /* nobody would call again before the line has more */
      }
      check_untouched(framing, buffer, capacity);
      continue;
    }
    memset(buffer, UNTOUCHED, capacity);
  }
  printf("end\n");
}

static void send(size_t size)
{
  bool sent;

  line.out_size = 0;
  sent = xrce_framing_send(&line, bytes, size);
  print(sent ? "sent" : "failed", line.out, line.out_size);
}

int main(void)
{
  xrce_framing_t framing;
  uint8_t * buffer = NULL;
  size_t capacity = 0;

  while (fgets(text, (int)sizeof(text), stdin) != NULL) {
    unsigned long number = 0;
    unsigned long piece = 0;

    if (sscanf(text, "open %lu %lu", &number, &piece) == 2) {
      free(buffer);
      capacity = number;
      buffer = malloc(capacity); /* exactly as large, so that the sanitizer sees one byte more */
      memset(buffer, UNTOUCHED, capacity);
      memset(&framing, 0, sizeof(framing));
      line.piece = piece;
    } else if (sscanf(text, "room %lu", &number) == 1 || sscanf(text, "silent %lu", &number) == 1) {
      line.room = number;
      line.tells = text[0] == 'r';
    } else if (strncmp(text, "feed ", 5) == 0 && buffer != NULL) {
      feed(&framing, buffer, capacity, from_hex(&text[5]));
    } else if (strncmp(text, "send ", 5) == 0) {
      send(from_hex(&text[5]));
    }
    (void)fflush(stdout);
  }
  free(buffer);
  return 0;
}
