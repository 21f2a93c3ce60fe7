/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the library asks of the system below it. A port implements the groups that the selection uses; each
 * function is a symbol of its own, so that what nobody calls is not linked. The library calls these from the
 * task that calls it, and keeps no pointer that it hands over.
 *
 * Groups: time and sleep, lock, waiting, timers, unique id, UDP, TCP, multicast, serial line. A further group (tasks, memory sections,
 * other transports) is added here with the component that needs it.
 */
#ifndef MICROROS_PORT_H
#define MICROROS_PORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- time and sleep --- */

/* Returns milliseconds since some start; never goes back, starts again at 0 after 2^32 - 1. */
uint32_t port_time_ms(void);

/* Returns nanoseconds since 1970-01-01 00:00 UTC, as far as the system knows. */
int64_t port_time_epoch_ns(void);

/* Sleeps at least `duration_ms`; 0 yields. */
void port_sleep_ms(uint32_t duration_ms);

/* Returns nanoseconds since some start; never goes back. Clocks and the executor's periods use it. */
int64_t port_time_steady_ns(void);

/* --- lock; for applications with the component multithread --- */

/* Waits for the one lock of the library; the task that has it takes it again at once, and gives it back as often. Holders
 * should inherit priority. No interrupt calls these. */
void port_lock(void);
void port_unlock(void);

/* --- waiting; for the executor --- */

/*
 * Waits until something may have arrived on the transport with this handle (of port_udp_t, port_serial_t; -1: there is
 * none), until port_wake, or for `timeout_ms`; may come back early. A port_wake since the last wait counts. The processor
 * rests meanwhile.
 */
void port_wait(intptr_t handle, uint32_t timeout_ms);

/* Ends the wait that is under way, or else the next one. May be called by any task, and by an interrupt. */
void port_wake(void);

/* --- timers; for those that the application file declares with a `kind` --- */

/* Called at each tick, by an interrupt or any task; `timer` is the number that the timer was started with. */
typedef void (*port_timer_tick_t)(uint16_t timer);

/* `kind: rtos`. Starts a timer of the system that ticks every `period_ns`, for the first time in one period; `timer` is
 * below MICROROS_TIMERS_MAX, and each number is one timer. False: there is none. */
bool port_timer_start(uint16_t timer, int64_t period_ns, port_timer_tick_t tick);

/* After it no tick comes. */
void port_timer_stop(uint16_t timer);

/* `kind: hardware`: the same two, which the application provides on every system. */
bool port_hardware_timer_start(uint16_t timer, int64_t period_ns, port_timer_tick_t tick);
void port_hardware_timer_stop(uint16_t timer);

/* --- unique id --- */

/* Returns a number that no other device has, never 0: of a board the same over a restart, of a program on a host drawn
 * when it starts. The client key where the application file has none. */
uint32_t port_unique_id(void);

/* --- UDP --- */

/* One socket; `handle` is the port's own, of which the library only keeps a copy. */
typedef struct port_udp_t {
  intptr_t handle;
} port_udp_t;

/* Opens a socket that talks to one peer and hears no other. `host` is an address in digits, IPv4 or, where
 * the system has it, IPv6, copied before the call returns. False: no network, or no such address. Does not block. */
bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port);

void port_udp_close(port_udp_t * udp);

/* Sends one datagram without blocking. False: not sent. */
bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size);

/* Takes one datagram without blocking. Returns its length, 0 when there is none, -1 when it did not fit
 * `capacity`. */
int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity);

/* The same two for a device that sleeps: agents know a client over UDP by its address and port. The first opens a socket at
 * the local port that the second has told; 0 is any. */
bool port_udp_open_local(port_udp_t * udp, const char * host, uint16_t port, uint16_t local);
uint16_t port_udp_local(const port_udp_t * udp);

/* --- TCP --- */

/* One connection; `handle` is the port's own, of which the library only keeps a copy. */
typedef struct port_tcp_t {
  intptr_t handle;
} port_tcp_t;

/* Begins to connect, without blocking; `host` as for UDP. False: no network, or no such address. */
bool port_tcp_open(port_tcp_t * tcp, const char * host, uint16_t port);

void port_tcp_close(port_tcp_t * tcp);

/* Hands over what the connection has room for, without blocking. Returns how many bytes that is, 0 while it is being made,
 * -1 when there is no connection any more, or there never was. */
int32_t port_tcp_send(port_tcp_t * tcp, const uint8_t * data, size_t size);

/* Takes what has arrived, without blocking. Returns how many bytes that is, at most `capacity`, 0 when there is nothing, -1
 * as above. */
int32_t port_tcp_receive(port_tcp_t * tcp, uint8_t * buffer, size_t capacity);

/* --- multicast; for the search for agents --- */

enum { PORT_MULTICAST_ADDRESS = 4 }; /* bytes of an IPv4 address, as on the wire */

/* A socket that sends to groups and takes what comes back; `handle` as above. */
typedef struct port_multicast_t {
  intptr_t handle;
} port_multicast_t;

/* False: no network. */
bool port_multicast_open(port_multicast_t * multicast);

void port_multicast_close(port_multicast_t * multicast);

/* Sends one datagram to a group, an IPv4 address in digits, without blocking. False: not sent. */
bool port_multicast_send(
  port_multicast_t * multicast, const char * group, uint16_t port, const uint8_t * data, size_t size);

/* Takes one datagram without blocking, cut to `capacity`, and who sent it (PORT_MULTICAST_ADDRESS bytes). Returns its
 * length, 0 when there is none. */
size_t port_multicast_receive(
  port_multicast_t * multicast, uint8_t * buffer, size_t capacity, uint8_t * sender);

/* --- serial line --- */

/* One line of bytes; `handle` is the port's own, of which the library only keeps a copy. */
typedef struct port_serial_t {
  intptr_t handle;
} port_serial_t;

/* Opens the line; `device` is its name where there is an operating system, "" for the one that a board has.
 * False: there is no such line, or it cannot have `baud` bits per second. Does not block. */
bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud);

void port_serial_close(port_serial_t * serial);

/* Returns how many bytes port_serial_write takes now; it shrinks by calls of port_serial_write alone. SIZE_MAX: the port
 * does not know, its port_serial_write waits for the pace of the line. */
size_t port_serial_room(port_serial_t * serial);

/* Hands all bytes to the line, which sends them while the program goes on: by interrupt, DMA or a task of its own. Does
 * not wait where they are not more than port_serial_room says. False: they were not all taken. */
bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size);

/*
 * The next two only where the board's line has a driver of this project, and the plan says so: a message that its owner keeps
 * as it is until it has left goes to the line without a copy. Behind what was written before the interrupt calls `next` for
 * each byte, until that returns -1, and then goes on with what was written since. False: another one is on its way.
 */
typedef int32_t (*port_serial_next_t)(void * context);
bool port_serial_send_kept(port_serial_t * serial, port_serial_next_t next, void * context);

/* Breaks it off where it stands: nobody calls `next` any more. */
void port_serial_break_off(port_serial_t * serial);

/* Returns whether such a message is on its way. */
bool port_serial_has_kept(const port_serial_t * serial);

/* Returns whether all that was handed to the line has left the program's memory. For flush and sleep. */
bool port_serial_is_idle(port_serial_t * serial);

/* Takes what has arrived, without blocking. Returns how many bytes that is, at most `capacity`. */
size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_H */
