/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Agent discovery (OMG DDS-XRCE 1.0, 9.3): GET_INFO to a multicast group, answered by INFO from each agent
 * with its locators. Each locator is tried in turn, since a device may reach only some of them. Only IPv4
 * locators are used.
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

/* Multicast group of the request; a transport with this host needs discovery. */
#define XRCE_DISCOVERY_GROUP "239.255.0.2"

enum { XRCE_DISCOVERY_PLACES = 8, XRCE_DISCOVERY_REQUEST = 16, XRCE_DISCOVERY_HOST = 16 };

typedef struct xrce_place_t {
  uint8_t address[PORT_MULTICAST_ADDRESS];
  uint16_t port;
} xrce_place_t;

/* Zero-initialized: discovery has not started. */
typedef struct xrce_discovery_t {
  port_multicast_t group;
  uint32_t due_ms;       /* when to ask again; while a locator is tried: its deadline */
  uint32_t since_ms;     /* start of the discovery */
  uint32_t requested_ms; /* time of the last request */
  bool wanted;           /* this session needs an agent */
  bool searching;
  bool open; /* the socket is open */
  bool trying;
  uint8_t count; /* locators, of which `next` were tried */
  uint8_t next;
  xrce_place_t places[XRCE_DISCOVERY_PLACES];
  char host[XRCE_DISCOVERY_HOST]; /* the current locator, as text */
} xrce_discovery_t;

/*
 * Advances the discovery of a session; returns whether the session has an address to connect to. Never
 * blocks. */
bool xrce_discovery_step(xrce_client_t * client, uint32_t now);

/* Sends the request when it is due and processes answers. Returns whether an untried locator exists. Uses
 * the input buffer during the call, if that is free; `discovery` need not belong to the client. */
bool xrce_discovery_search(xrce_discovery_t * discovery, uint32_t now);

/* Takes the next locator: writes its address to `host` as text, and returns its port. One must exist. */
uint16_t xrce_discovery_take(xrce_discovery_t * discovery);

/* Ends a discovery and closes its socket. */
void xrce_discovery_end(xrce_discovery_t * discovery);

/* Writes GET_INFO into `message`, XRCE_DISCOVERY_REQUEST bytes. */
void xrce_discovery_write_request(uint8_t * message);

/* Adds the locators of an INFO, each once; the one with the sender's address first. A truncated message is
 * used up to its end. */
void xrce_discovery_on_info(
  xrce_discovery_t * discovery, const uint8_t * message, size_t size, const uint8_t * sender);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_DISCOVERY_H */
