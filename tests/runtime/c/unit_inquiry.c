/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Two tasks ask for agents over two lines of bytes while the session is looked for over a third: neither reads what the other
 * has received. The answer on the first line stops in the middle until a message to somebody else was taken from the second, or nobody
 * takes it; then the second line waits for the first.
 */
#define _POSIX_C_SOURCE 200809L
#include "unit.h"

#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/xrce_client.h"
#include "microros/xrce_framing.h"
#include "microros/xrce_wire.h"

#include <rmw_microros/rmw_microros.h>

#include <pthread.h>
#include <string.h>

enum { MESSAGE = 36, MOST = 256, STOP_AT = 24, PATIENCE = 100, TIMEOUT_MS = 5000 };

typedef struct line_t {
  size_t size;
  size_t at;
  size_t other; /* where what comes first, and is for somebody else, ends */
  uint8_t bytes[MOST];
} line_t;

static line_t first;
static line_t second;
static volatile bool first_began; /* the library's lock is around each use */
static int stops;

static void put(line_t * line, uint8_t byte)
{
  if (byte == XRCE_FRAME_FLAG || byte == XRCE_FRAME_ESCAPE) {
    line->bytes[line->size++] = XRCE_FRAME_ESCAPE;
    byte ^= XRCE_FRAME_FLIP;
  }
  line->bytes[line->size++] = byte;
}

/* Appends the agent's frame around a message with one submessage. */
static void put_frame(line_t * line, uint8_t submessage)
{
  uint8_t message[MESSAGE] = {XRCE_SESSION_NONE, XRCE_STREAM_NONE, 0, 0, 0, 1, MESSAGE - 8, 0};
  uint16_t crc = 0;

  message[4] = submessage;
  line->bytes[line->size++] = XRCE_FRAME_FLAG;
  put(line, XRCE_FRAME_ADDRESS_AGENT);
  put(line, XRCE_FRAME_ADDRESS_CLIENT);
  put(line, MESSAGE);
  put(line, 0);
  for (size_t i = 0; i < MESSAGE; ++i) {
    crc = xrce_framing_crc(crc, message[i]);
    put(line, message[i]);
  }
  put(line, (uint8_t)(crc & 0xffu));
  put(line, (uint8_t)(crc >> 8));
}

static bool my_open(struct uxrCustomTransport * transport)
{
  (void)transport;
  return true;
}

static bool my_close(struct uxrCustomTransport * transport)
{
  (void)transport;
  return true;
}

static size_t my_write(
  struct uxrCustomTransport * transport, const uint8_t * data, size_t size, uint8_t * error)
{
  (void)transport;
  (void)data;
  *error = 0;
  return size;
}

static size_t my_read(
  struct uxrCustomTransport * transport, uint8_t * buffer, size_t capacity, int timeout, uint8_t * error)
{
  line_t * line = (line_t *)transport->args;
  size_t end = line->size;
  size_t size;

  (void)timeout;
  *error = 0;
  if (line == &first && second.at < second.other && stops < PATIENCE) {
    end = STOP_AT;
    stops += line->at == end ? 1 : 0;
  } else if (line == &second && first.at != first.size) {
    end = second.other;
  }
  size = end - line->at < capacity ? end - line->at : capacity;
  memcpy(buffer, &line->bytes[line->at], size);
  line->at += size;
  first_began = first_began || line == &first;
  return size;
}

static void * ask(void * line)
{
  rmw_init_options_t options = rmw_get_zero_initialized_init_options();

  CHECK(
    rmw_uros_options_set_custom_transport(true, line, my_open, my_close, my_write, my_read, &options) ==
    RMW_RET_OK);
  CHECK(rmw_uros_ping_agent_options(TIMEOUT_MS, 1, &options) == RMW_RET_OK);
  return NULL;
}

int main(void)
{
  pthread_t tasks[2];

  put_frame(&first, XRCE_INFO);
  put_frame(&second, XRCE_STATUS);
  second.other = second.size;
  put_frame(&second, XRCE_INFO);
  rmw_client_instance()->session.state = (uint8_t)XRCE_CONNECTING;
  CHECK(pthread_create(&tasks[0], NULL, ask, &first) == 0);
  for (bool began = false; !began;) { /* the first asks first */
    port_sleep_ms(1);
    port_lock();
    began = first_began;
    port_unlock();
  }
  CHECK(pthread_create(&tasks[1], NULL, ask, &second) == 0);
  CHECK(pthread_join(tasks[0], NULL) == 0);
  CHECK(pthread_join(tasks[1], NULL) == 0);
  CHECK(stops != 0 && first.at == first.size && second.at == second.size);
  return 0;
}
