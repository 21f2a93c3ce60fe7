/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Search for agents (OMG DDS-XRCE 1.0, 9.3): GET_INFO to a multicast group, and INFO from each agent with the places where
 * it listens. Each place is tried in turn, since a device may reach only some; IPv4 places count, others are passed over.
 */
#ifndef MICROROS_XRCE_DISCOVERY_H
#define MICROROS_XRCE_DISCOVERY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/port.h"
#include "microros/xrce_session.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where agents are asked for; a transport with this host is one whose agent is to be found. */
#define XRCE_DISCOVERY_GROUP "239.255.0.2"

enum { XRCE_DISCOVERY_PLACES = 8, XRCE_DISCOVERY_QUESTION = 16, XRCE_DISCOVERY_HOST = 16 };

typedef struct xrce_place_t {
  uint8_t address[PORT_MULTICAST_ADDRESS];
  uint16_t port;
} xrce_place_t;

/* All zero: not begun. */
typedef struct xrce_discovery_t {
  port_multicast_t group;
  uint32_t due_ms;   /* when to ask again, or, while a place is tried, when to give it up */
  uint32_t since_ms; /* when the search began */
  uint32_t asked_ms; /* when it was asked last */
  bool wanted;       /* the agent of this session is searched for */
  bool searching;
  bool open; /* the search has its socket */
  bool trying;
  uint8_t count; /* of places, of which `next` were tried */
  uint8_t next;
  xrce_place_t places[XRCE_DISCOVERY_PLACES];
  char host[XRCE_DISCOVERY_HOST]; /* the place that is tried, as text */
} xrce_discovery_t;

/* Carries the search of a session on; returns whether the session has a place to connect to. Never blocks. */
bool xrce_discovery_step(xrce_client_t * client, uint32_t now);

/* Asks when that is due and takes what was answered. Returns whether there is a place that was not tried. `client` lends its
 * input for the call, where that is free; `discovery` need not be its. */
bool xrce_discovery_search(xrce_client_t * client, xrce_discovery_t * discovery, uint32_t now);

/* Takes the next place: writes its address to `host` as text, and returns its port. There must be one. */
uint16_t xrce_discovery_take(xrce_discovery_t * discovery);

/* Ends a search. */
void xrce_discovery_end(xrce_discovery_t * discovery);

/* Writes GET_INFO into `message`, XRCE_DISCOVERY_QUESTION bytes. */
void xrce_discovery_write_question(uint8_t * message);

/* Adds the places that an INFO names, each once; first that whose address is the sender's. A message that was cut counts up
 * to where it was. */
void xrce_discovery_on_info(
  xrce_discovery_t * discovery, const uint8_t * message, size_t size, const uint8_t * sender);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_DISCOVERY_H */
