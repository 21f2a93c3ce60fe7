/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions that the library needs from the system below it. A port implements the groups that the
 * selection uses. Each function is in a separate section, so that unused ones are not linked. The library
 * calls them from the task that called the library, and keeps no pointer that it is given.
 *
 * Groups: time and sleep, lock, waiting, timers, unique id, UDP, TCP, multicast, serial line. A further
 * group (tasks, memory sections, other transports) is added here with the component that needs it.
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

/* Returns milliseconds since an arbitrary start; monotonic, wraps to 0 after 2^32 - 1. */
uint32_t port_time_ms(void);

/* Returns nanoseconds since 1970-01-01 00:00 UTC, as far as the system knows the time of day. */
int64_t port_time_epoch_ns(void);

/* Sleeps at least `duration_ms`; 0 yields. */
void port_sleep_ms(uint32_t duration_ms);

/* Returns nanoseconds since an arbitrary start; monotonic. Used by clocks and the executor's periods. */
int64_t port_time_steady_ns(void);

/* --- lock; for applications with the component multithread --- */

/* Acquires the library's only lock; blocks until it is free. The lock is recursive: unlock as many times
 * as it was locked. Holders should inherit priority. Never called from an interrupt. */
void port_lock(void);
void port_unlock(void);

/* --- waiting; for the executor --- */

/*
 * Blocks until data may have arrived on the transport with this handle (of port_udp_t, port_serial_t; -1:
 * no handle), until port_wake, or for `timeout_ms`; may return early. A port_wake since the previous wait
 * ends this one at once. What arrives on a link with another board (microros/links.h) ends it, too. The
 * processor may sleep meanwhile.
 */
void port_wait(intptr_t handle, uint32_t timeout_ms);

/*
 * Ends the current wait, or the next one if none is in progress. Callable from any task and from an
 * interrupt. */
void port_wake(void);

/* --- timers; for those that the application file declares with `kind` --- */

/* Called at each tick, from an interrupt or any task; `timer` is the number passed to the start function. */
typedef void (*port_timer_tick_t)(uint16_t timer);

/* `kind: rtos`. Starts a system timer that ticks every `period_ns`, the first time after one period.
 * `timer` is below MICROROS_TIMERS_MAX and identifies the timer. Returns false if the system has no timer
 * left. */
bool port_timer_start(uint16_t timer, int64_t period_ns, port_timer_tick_t tick);

/* Stops the timer: no tick is delivered after the call. */
void port_timer_stop(uint16_t timer);

/* `kind: hardware`: the same two functions, which the application provides on every system. */
bool port_hardware_timer_start(uint16_t timer, int64_t period_ns, port_timer_tick_t tick);
void port_hardware_timer_stop(uint16_t timer);

/* --- unique id --- */

/* Returns a number that is unique to the device, never 0: constant over restarts on a board, drawn at
 * program start on a host. It is the client key if the application file sets none. */
uint32_t port_unique_id(void);

/* --- UDP --- */

/* One socket. `handle` belongs to the port; the library only copies it. */
typedef struct port_udp_t {
  intptr_t handle;
} port_udp_t;

/* Opens a socket that exchanges datagrams with one peer only. `host` is a numeric address, IPv4 or, where
 * supported, IPv6; it is copied before the call returns. Returns false without a network or for an invalid
 * address. Does not block. */
bool port_udp_open(port_udp_t * udp, const char * host, uint16_t port);

void port_udp_close(port_udp_t * udp);

/* Sends one datagram without blocking. Returns false if it was not sent. */
bool port_udp_send(port_udp_t * udp, const uint8_t * data, size_t size);

/* Receives one datagram without blocking. Returns its length, 0 if none has arrived, -1 if it did not fit
 * into `capacity`. */
int32_t port_udp_receive(port_udp_t * udp, uint8_t * buffer, size_t capacity);

/* For devices that sleep: an agent knows a UDP client by its address and port. The first function opens a
 * socket bound to `local_port`, as returned by the second one before the sleep; 0 is any port. */
bool port_udp_open_local(port_udp_t * udp, const char * host, uint16_t port, uint16_t local);
uint16_t port_udp_local(const port_udp_t * udp);

/* --- TCP --- */

/* One connection. `handle` belongs to the port; the library only copies it. */
typedef struct port_tcp_t {
  intptr_t handle;
} port_tcp_t;

/*
 * Starts to connect, without blocking; `host` as for UDP. Returns false without a network or for an
 * invalid address. */
bool port_tcp_open(port_tcp_t * tcp, const char * host, uint16_t port);

void port_tcp_close(port_tcp_t * tcp);

/* Sends as much as the connection accepts, without blocking. Returns the number of bytes, 0 while the
 * connection is being established, -1 if it is closed or was refused. */
int32_t port_tcp_send(port_tcp_t * tcp, const uint8_t * data, size_t size);

/* Receives without blocking. Returns the number of bytes, at most `capacity`; 0 if nothing has arrived, -1
 * as above. */
int32_t port_tcp_receive(port_tcp_t * tcp, uint8_t * buffer, size_t capacity);

/* --- multicast; for agent discovery --- */

enum { PORT_MULTICAST_ADDRESS = 4 }; /* bytes of an IPv4 address, as on the wire */

/* A socket that sends to groups and receives the answers; `handle` as above. */
typedef struct port_multicast_t {
  intptr_t handle;
} port_multicast_t;

/* Returns false without a network. */
bool port_multicast_open(port_multicast_t * multicast);

void port_multicast_close(port_multicast_t * multicast);

/*
 * Sends one datagram to a group, a numeric IPv4 address, without blocking. Returns false if it was not
 * sent. */
bool port_multicast_send(
  port_multicast_t * multicast, const char * group, uint16_t port, const uint8_t * data, size_t size);

/* Receives one datagram without blocking, truncated to `capacity`, and its sender's address
 * (PORT_MULTICAST_ADDRESS bytes). Returns its length, 0 if none has arrived. */
size_t port_multicast_receive(
  port_multicast_t * multicast, uint8_t * buffer, size_t capacity, uint8_t * sender);

/* --- serial line --- */

/* One serial line. `handle` belongs to the port; the library only copies it. Less than -1: its device is gone, and the
 * port looks for it while the library reads and writes. */
typedef struct port_serial_t {
  intptr_t handle;
} port_serial_t;

/* Opens the line. `device` is its name on an operating system, "" for the only line of a board; it stays as it is until
 * the line is closed. Returns false if the line does not exist or does not support `baud` bits per second. Does not block. */
bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud);

void port_serial_close(port_serial_t * serial);

/* Returns the number of bytes that port_serial_write accepts without waiting; only port_serial_write
 * reduces it. SIZE_MAX: unknown, port_serial_write waits for the line. */
size_t port_serial_room(port_serial_t * serial);

/* Queues all bytes for transmission by interrupt, DMA or a separate task. Does not wait if there are at
 * most as many as port_serial_room returned. Returns false if some were not accepted. */
bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size);

/*
 * The next two are used only if the board has a serial driver of this project and the plan says so: they
 * send a message without a copy, from memory that its owner leaves unchanged until it is sent. After all
 * bytes written before, the interrupt calls `next` for each byte until that returns -1, then continues
 * with bytes written since. Returns false while another such message is in progress.
 */
typedef int32_t (*port_serial_next_t)(void * context);
bool port_serial_send_kept(port_serial_t * serial, port_serial_next_t next, void * context);

/* Aborts it at once: `next` is not called again. */
void port_serial_break_off(port_serial_t * serial);

/* Returns whether such a message is in progress. */
bool port_serial_has_kept(const port_serial_t * serial);

/* Returns whether all queued bytes have left the program's memory. For flush and sleep. */
bool port_serial_is_idle(port_serial_t * serial);

/* Reads received bytes without blocking. Returns their number, at most `capacity`. */
size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_PORT_H */
