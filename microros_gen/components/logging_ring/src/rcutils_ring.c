/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rcutils_ring.h"

#include "microros/epoch.h"
#include "microros/rcutils_ring_hooks.h"
#include "microros/rcutils_rosout.h"
#include "microros/xrce_rosout.h"
#include "microros_config.h"
#include "rcl_interfaces/msg/log.h"

#include <stddef.h>

enum { RING_HEADER = 4, RING_LINE_MAX = rcl_interfaces__msg__Log__MAX_ENCODED_SIZE };

/*
 * Linker scripts of boards place this variable by its section, .bss.microros_log_kept, in memory that is not cleared
 * at the start. Its initial content is arbitrary, so everything is checked before it is used: the mark, the place,
 * the checksum of each line.
 */
typedef struct ring_kept_t {
  uint32_t mark;
  uint32_t
    place; /* low half: where the oldest line begins, high half: bytes of all lines. One store changes both. */
  uint8_t lines[MICROROS_LOG_RING_SIZE]; /* each: its size and its checksum, low byte first, and the body */
} ring_kept_t;

static volatile ring_kept_t microros_log_kept;

static const uint32_t ring_mark = 0x4c4f4721u ^ (uint32_t)MICROROS_LOG_RING_SIZE;
static uint32_t ring_before; /* bytes of lines from before the reset that wait for /rosout */
static bool ring_is_checked;
static bool ring_is_announced;
static bool ring_is_announcing;

static uint32_t ring_first(void)
{
  return microros_log_kept.place & 0xffffu;
}

static uint32_t ring_used(void)
{
  return microros_log_kept.place >> 16;
}

static void ring_set(uint32_t first, uint32_t used)
{
  microros_log_kept.place = first | (used << 16);
}

static uint32_t ring_at(uint32_t index)
{
  const uint32_t room = MICROROS_LOG_RING_SIZE - ring_first();

  return index < room ? ring_first() + index : index - room;
}

static uint32_t ring_number(uint32_t index)
{
  return (uint32_t)microros_log_kept.lines[ring_at(index)] |
         ((uint32_t)microros_log_kept.lines[ring_at(index + 1u)] << 8);
}

/* CRC-16/XMODEM of one more byte. */
static uint32_t ring_checksum(uint32_t sum, uint8_t byte)
{
  uint32_t next = sum ^ ((uint32_t)byte << 8);

  for (uint32_t bit = 0; bit < 8u; ++bit) {
    next = (next & 0x8000u) != 0u ? (next << 1) ^ 0x1021u : next << 1;
  }
  return next & 0xffffu;
}

static void ring_check(void)
{
  if (ring_is_checked) {
    return;
  }
  ring_is_checked = true;
  if (
    microros_log_kept.mark != ring_mark || ring_first() >= (uint32_t)MICROROS_LOG_RING_SIZE ||
    ring_used() > (uint32_t)MICROROS_LOG_RING_SIZE) {
    ring_set(0u, 0u);
    microros_log_kept.mark = ring_mark;
  }
  ring_before = ring_used();
}

/*
 * Returns the size of the oldest line with its header. An invalid line ends the list, because the start of the next
 * one is unknown.
 */
static uint32_t ring_oldest(void)
{
  const uint32_t used = ring_used();
  const uint32_t size = used < (uint32_t)RING_HEADER ? used : (uint32_t)RING_HEADER + ring_number(0u);

  return size > used ? used : size;
}

static void ring_drop(void)
{
  const uint32_t size = ring_oldest();

  ring_before -= size < ring_before ? size : ring_before;
  ring_set(ring_at(size), ring_used() - size);
}

bool microros_ring_takes(int severity)
{
  return severity >= (int)MICROROS_LOG_RING_LEVEL && !ring_is_announcing;
}

/* A reset meanwhile leaves the lines as they were, or without the oldest ones: the place changes before and after. */
void microros_ring_put(const uint8_t * body, uint32_t size)
{
  uint32_t sum = 0;
  uint32_t index;

  ring_check();
  /* at most MICROROS_LOG_RING_SIZE / RING_HEADER + 1 rounds */
  while ((uint32_t)MICROROS_LOG_RING_SIZE - ring_used() < (uint32_t)RING_HEADER + size) {
    ring_drop();
  }
  index = ring_used();
  for (uint32_t i = 0; i < size; ++i) { /* at most RING_LINE_MAX rounds */
    microros_log_kept.lines[ring_at(index + (uint32_t)RING_HEADER + i)] = body[i];
    sum = ring_checksum(sum, body[i]);
  }
  microros_log_kept.lines[ring_at(index)] = (uint8_t)(size & 0xffu);
  microros_log_kept.lines[ring_at(index + 1u)] = (uint8_t)(size >> 8);
  microros_log_kept.lines[ring_at(index + 2u)] = (uint8_t)(sum & 0xffu);
  microros_log_kept.lines[ring_at(index + 3u)] = (uint8_t)(sum >> 8);
  ring_set(ring_first(), index + (uint32_t)RING_HEADER + size);
}

/* Copies the body of the oldest line; returns its size, 0 if it is damaged or not a line of this image. */
static uint32_t ring_copy(uint8_t * body)
{
  const uint32_t whole = ring_oldest();
  const uint32_t size = whole < (uint32_t)RING_HEADER ? 0u : whole - (uint32_t)RING_HEADER;
  uint32_t sum = 0;

  if (size > (uint32_t)RING_LINE_MAX) {
    return 0;
  }
  /* at most RING_LINE_MAX rounds, MICROROS_LOG_RING_SIZE in each microros_ring_step */
  for (uint32_t i = 0; i < size; ++i) {
    body[i] = microros_log_kept.lines[ring_at((uint32_t)RING_HEADER + i)];
    sum = ring_checksum(sum, body[i]);
  }
  return size != 0u && ring_number(2u) == sum ? size : 0u;
}

static void ring_publish_oldest(void)
{
  uint8_t body[RING_LINE_MAX];
  const uint32_t size = ring_copy(body);

  if (size != 0u) {
    (void)xrce_rosout_put(body, size); /* has room */
  }
  ring_drop();
}

/* Whatever the level of /rosout: the times of the lines alone do not tell. Not in the ring, where it would replace a line. */
static void ring_announce(void)
{
  ring_is_announced = true;
  ring_is_announcing = true;
  microros_rosout_publish(/* at most 1 calls */
                          NULL, RCUTILS_LOG_SEVERITY_INFO, "microros", microros_epoch_known_ns(),
                          "lines from before the reset follow");
  ring_is_announcing = false;
}

void microros_ring_step(const xrce_client_t * client)
{
  ring_check();
  /* at most MICROROS_LOG_RING_SIZE / RING_HEADER + 2 rounds: each drops a line, or announces them */
  while (ring_before != 0u && xrce_rosout_is_open(client) && xrce_rosout_has_room((uint32_t)RING_LINE_MAX)) {
    if (!ring_is_announced) {
      ring_announce(); /* at most 1 calls */
    } else {
      ring_publish_oldest();
    }
  }
}
