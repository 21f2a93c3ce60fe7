/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/xrce_peer_find.h"

#include "microros/xrce_client.h"
#include "microros/xrce_peer_find_note.h"
#include "microros/xrce_wire.h"

/* What is known of the interface of a link. It outlives a sleep and the session with an agent, as the transport does. */
typedef struct peer_search_t {
  uint32_t since_ms; /* when it was missed, or last looked for */
  bool runs;         /* it is looked for */
  bool failed;       /* the network did not take the last message */
} peer_search_t;

static peer_search_t searches[MICROROS_PEERS];

/* Returns whether the port has noticed that the interface is gone, or nothing is open. */
static bool peer_is_closed(uint8_t index)
{
  const xrce_peer_port_t * port = &xrce_peer_ports[index];

  return !port->is_open || xrce_transport_handle(&port->transport) < -1;
}

static void peer_open_again(uint8_t index)
{
  xrce_peer_port_t * port = &xrce_peer_ports[index];

  if (port->is_open) {
    xrce_transport_close(&port->transport);
  }
  port->is_open = xrce_peer_open(&port->transport, index);
  searches[index].failed = true; /* until something is sent: the interface may be down */
}

void xrce_peer_find_note(uint8_t index, bool is_sent)
{
  searches[index].failed = !is_sent;
}

/* Looks for the interface. An open link with a session keeps its address: with another one the other board would not
 * hear it, and the same one works again when the interface returns. */
static void peer_look(xrce_client_t * client, uint8_t index)
{
  const xrce_peer_t * peer = &client->peers[index];

  if ((!peer->ready && !peer->more) || peer_is_closed(index)) {
    peer_open_again(index);
  }
  if (peer->ready) {
    xrce_peer_heartbeat(client, index); /* notes whether the network takes it */
  }
}

bool xrce_peer_find(xrce_client_t * client, uint8_t index, uint32_t now)
{
  peer_search_t * search = &searches[index];
  const xrce_peer_t * peer = &client->peers[index];
  const bool is_lost = search->failed || peer_is_closed(index);
  const bool is_late = search->runs;

  if (!is_lost && peer->ready) {
    search->runs = false;
    return false;
  }
  if (is_late && now - search->since_ms < XRCE_PEER_FIND_MS) {
    return is_lost && peer->lost;
  }
  search->runs = true;
  search->since_ms = now;
  if (is_late) {
    peer_look(client, index);
  }
  return is_lost && (peer->lost || (is_late && peer->ready));
}

uint32_t xrce_peer_find_left(uint8_t index, uint32_t left, uint32_t now)
{
  const peer_search_t * search = &searches[index];

  return search->runs ? xrce_sooner(left, search->since_ms + XRCE_PEER_FIND_MS, now) : left;
}
