/* SPDX-License-Identifier: Apache-2.0 */
/* Both directions of a serial line: calls without end, each with chunks of any size and contents; messages of any size. */
#include "proof.h"

#include "microros/xrce_framing.h"

struct xrce_transport_t {
  int handle;
};

static struct xrce_transport_t line;
static xrce_framing_t framing;
static uint8_t buffer[UINT16_MAX];
static uint8_t message[UINT16_MAX + 1];

size_t xrce_line_room(struct xrce_transport_t * to)
{
  (void)to;
  return proof_size(SIZE_MAX);
}

bool xrce_line_write(struct xrce_transport_t * to, const uint8_t * data, size_t size)
{
  (void)to;
  //@ check \valid_read(data + (0 .. size - 1));
  return proof_bool();
}

size_t xrce_line_read(struct xrce_transport_t * from, uint8_t * chunk, size_t capacity)
{
  (void)from;
  proof_any(chunk, capacity);
  return proof_size(capacity);
}

int main(void)
{
  proof_any(message, sizeof(message));
  (void)xrce_framing_send(&line, message, proof_size(sizeof(message)));
  while (proof_bool()) {
    const int32_t got = xrce_framing_receive(&framing, &line, buffer, sizeof(buffer));
    //@ check -1 <= got <= UINT16_MAX;
  }
  return 0;
}
