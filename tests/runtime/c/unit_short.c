/* SPDX-License-Identifier: Apache-2.0 */
/* Submessages that are too short for any that an agent sends, in a program with a task for the session. */
#include "unit.h"

#include <microros/rmw_client.h>
#include <microros/xrce_client.h>
#include <microros/xrce_session.h>

#include <stdint.h>

static uint32_t malformed_after(const uint8_t * message, size_t size)
{
  xrce_client_t * client = rmw_client_instance();
  const uint32_t before = client->session.statistics.malformed;

  CHECK(xrce_session_take_submessages(client, message, size, 0));
  return client->session.statistics.malformed - before;
}

int main(void)
{
  /* of a kind that the client does not know (0x0f), and ACKNACKs */
  static const uint8_t alone[] = {0x81, 0, 0, 0, 0x0f, 1, 4, 0, 1, 2, 3, 4};
  static const uint8_t too_short_alone[] = {0x81, 0, 0, 0, 0x0a, 1, 4, 0, 0, 0, 0, 0};
  static const uint8_t whole[] = {0x81, 0, 0, 0, 0x0f, 1, 4, 0, 1, 2, 3, 4, 0x0a, 1, 5, 0, 0, 0, 0, 0, 0x80};
  static const uint8_t after_another[] = {
    0x81, 0, 0, 0, 0x0a, 1, 5, 0, 0, 0, 0, 0, 0x80, 0, 0, 0, 0x0a, 1, 4, 0, 0, 0, 0, 0};
  static const uint8_t unknown_after_another[] = {
    0x81, 0, 0, 0, 0x0f, 1, 0, 0, 0x0f, 1, 4, 0, 1, 2, 3, 4, 0x0f, 1, 0, 0};

  CHECK(malformed_after(alone, sizeof(alone)) == 0u);
  CHECK(malformed_after(too_short_alone, sizeof(too_short_alone)) == 1u);
  CHECK(malformed_after(whole, sizeof(whole)) == 0u);
  CHECK(malformed_after(after_another, sizeof(after_another)) == 1u);
  CHECK(malformed_after(unknown_after_another, sizeof(unknown_after_another)) == 2u);
  return 0;
}
