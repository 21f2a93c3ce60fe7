/* SPDX-License-Identifier: Apache-2.0 */
/* A large reply whose body is not known: after a sleep, until the node has its life cycle again. */
#include "microros/xrce_parts.h"

#include "microros/xrce_parts_hooks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BODY = 200, LONG_MS = 5000, NOW_MS = 1000 };

#define EXPECT(condition) \
  do { \
    if (!(condition)) { \
      (void)fprintf(stderr, "line %d: %s\n", __LINE__, #condition); \
      exit(1); \
    } \
  } while (0)

uint32_t xrce_session_pause(uint32_t wanted_ms)
{
  return wanted_ms;
}

bool xrce_session_send(xrce_session_t * session, const uint8_t * message, size_t size)
{
  (void)session;
  (void)message;
  (void)size;
  (void)fprintf(stderr, "sent\n");
  exit(1);
}

static uint32_t body(uint32_t from, uint32_t size, uint8_t * to)
{
  for (uint32_t i = 0; i < size; ++i) {
    to[i] = (uint8_t)(from + i);
  }
  return BODY;
}

int main(void)
{
  static xrce_client_t client;
  static const uint8_t identity[XRCE_IDENTITY_SIZE];

  client.session.state = (uint8_t)XRCE_READY;
  xrce_parts_begin(&client, 0, identity);
  EXPECT(!client.parts.busy && client.parts.size == 0u);
  EXPECT(xrce_parts_left(&client, LONG_MS, NOW_MS) == (uint32_t)LONG_MS);

  client.parts.body = body;
  xrce_parts_begin(&client, 0, identity);
  EXPECT(client.parts.busy && client.parts.size == (uint32_t)XRCE_PARTS_HEAD_SIZE + (uint32_t)BODY);
  EXPECT(xrce_parts_left(&client, LONG_MS, NOW_MS) == 1u);

  xrce_parts_wake(&client);
  EXPECT(client.parts.busy && xrce_parts_left(&client, LONG_MS, NOW_MS) == (uint32_t)LONG_MS);
  client.parts.outstanding = true;
  client.parts.due_ms = (uint32_t)NOW_MS - 1u;
  EXPECT(xrce_parts_left(&client, LONG_MS, NOW_MS) == (uint32_t)LONG_MS);
  xrce_parts_step(&client, NOW_MS);
  EXPECT(client.parts.outstanding && client.parts.due_ms == (uint32_t)NOW_MS - 1u);
  client.parts.body = body;
  EXPECT(xrce_parts_left(&client, LONG_MS, NOW_MS) == 1u);
  (void)printf("ok\n");
  return 0;
}
