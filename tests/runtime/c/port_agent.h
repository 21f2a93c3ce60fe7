/* SPDX-License-Identifier: Apache-2.0 */
/* A port whose time the unit makes, with an agent after its UDP group that grants everything at once. */
#ifndef PORT_AGENT_H
#define PORT_AGENT_H

#include "microros/port.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Steady time; waiting and sleeping move it on. Begins shortly before the milliseconds wrap. */
extern int64_t agent_now_ns;

/* Time of the day; 0: not known. */
extern int64_t agent_epoch_ns;

/* How often port_wait was called since the unit set this to 0. */
extern uint32_t agent_waits;

/* The agent is gone: it takes nothing and says nothing. `agent_asked` is called for each message that it would get. */
extern bool agent_silent;
extern void (*agent_asked)(uint8_t id);

/* Called once when this time is reached by waiting; then the unit may set the next one. */
extern int64_t agent_event_ns;
extern void (*agent_event)(void);

/* The function that the timer of this number ticks with; NULL: it rests. */
extern port_timer_tick_t agent_ticks[4];
extern int64_t agent_periods[4];

/* A sample arrives for the reader of this index among the endpoints. */
void agent_offer(uint16_t index, const uint8_t * body, uint8_t size);
void agent_offer_number(uint16_t index, int32_t value);

/* A request arrives for the replier of this index, or a reply for the requester to its last request. */
void agent_offer_request(uint16_t index, uint32_t number, int32_t value);
void agent_offer_reply(uint16_t index, int32_t value);

/* A reply that a replier wrote: whose it is, to which request, and the value. */
typedef struct agent_reply_t {
  uint16_t index;
  uint32_t number;
  int32_t value;
} agent_reply_t;

/* What repliers wrote; the unit sets the count to 0. */
enum { AGENT_REPLIES = 16 };
extern agent_reply_t agent_replies[AGENT_REPLIES];
extern size_t agent_reply_count;

/* While true, nothing that is written is acknowledged. */
extern bool agent_keeps_silent;

/* Acknowledges all that was written. */
void agent_acknowledge(void);

/* A datagram from anybody, cut to what the client takes; nothing where too many wait already. */
void agent_inject(const uint8_t * bytes, size_t size);

/* Samples written since the last call, and the last one as a number. */
uint32_t agent_written(int32_t * last);

#endif /* PORT_AGENT_H */
