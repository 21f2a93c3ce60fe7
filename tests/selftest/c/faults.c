/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Ports and types with a fault: the linker puts these functions between the self-test and the port (--wrap). The fault is
 * FAULT, of the environment or of the compiler.
 */
#define _GNU_SOURCE
#include "microros/message_type.h"
#include "microros/port.h"
#ifdef HAS_CAN
#include "microros/port_can.h"
#endif
#ifdef HAS_STORAGE
#include "microros/port_storage.h"
#endif
#ifdef HAS_TASKS
#include "microros/port_tasks.h"
#include <pthread.h>
#endif
#ifdef HAS_DECODER
#include "microros/cdr_decode.h"
#endif
#include "rosidl_runtime_c/message_type_support_struct.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#ifdef FAULT
#define IS(name) (strcmp(FAULT, name) == 0)
#else
static const char * chosen = "";

__attribute__((constructor)) static void choose(void)
{
  const char * fault = getenv("FAULT");

  chosen = fault == NULL ? "" : fault;
}
#define IS(name) (strcmp(chosen, name) == 0)
#endif

#define WRAP(result, name, parameters) \
  result __real_##name parameters; \
  result __wrap_##name parameters; \
  result __wrap_##name parameters

WRAP(uint32_t, port_time_ms, (void))
{
  static uint32_t first, calls;
  const uint32_t now = __real_port_time_ms();

  if (IS("time_back")) {
    return ++calls % 50u == 0u ? now - 100u : now;
  }
  if (IS("wraps")) {
    first = first == 0u ? now : first;
    return now - first - 400u;
  }
  return IS("time_stands") ? 7u : IS("time_coarse") ? now / 50u * 50u : now;
}

WRAP(int64_t, port_time_steady_ns, (void))
{
  static uint32_t calls;
  const int64_t now = __real_port_time_steady_ns();

  if (IS("steady_back")) {
    return ++calls % 50u == 0u ? now - 100000000 : now;
  }
  return IS("steady_slow") ? now / 2 : IS("steady_coarse") ? now / 50000000 * 50000000 : now;
}

WRAP(int64_t, port_time_epoch_ns, (void))
{
  static uint32_t calls;
  const int64_t now = __real_port_time_epoch_ns();
  const int64_t base = INT64_C(1600000000) * 1000000000;

  if (IS("epoch_back")) {
    return ++calls % 50u == 0u ? now - 100000000 : now;
  }
  return IS("epoch_slow") ? base + (now - base) / 2 : IS("epoch_stands") ? base : now;
}

WRAP(uint32_t, port_time_us, (void))
{
  static uint32_t calls;
  const uint32_t now = __real_port_time_us();

  if (IS("us_back")) {
    return ++calls % 50u == 0u ? now - 100000u : now;
  }
  return IS("us_slow") ? now / 2u : IS("us_coarse") ? now / 50000u * 50000u : now;
}

WRAP(void, port_sleep_ms, (uint32_t duration_ms))
{
  if (IS("stops")) {
    __builtin_trap();
  }
  if (IS("sleep_short")) {
    __real_port_sleep_ms(duration_ms / 2u);
  } else {
    __real_port_sleep_ms(IS("sleep_long") ? duration_ms + 80u : duration_ms);
  }
}

WRAP(void, port_wait, (intptr_t handle, uint32_t timeout_ms))
{
  if (IS("wait_never")) {
    return;
  }
  if (IS("wait_long")) {
    __real_port_sleep_ms(60);
  }
  __real_port_wait(handle, timeout_ms);
}

WRAP(void, port_wake, (void))
{
  if (!IS("wake_lost")) {
    __real_port_wake();
  }
}

WRAP(bool, port_timer_start, (uint16_t timer, int64_t period_ns, port_timer_tick_t tick))
{
  if (IS("timer_none")) {
    return false;
  }
  if (IS("timer_late")) {
    __real_port_sleep_ms(15);
  }
  if (IS("timer_slow")) {
    period_ns *= 2;
  }
  if (IS("timer_early")) {
    period_ns -= 2000000;
  }
  if (IS("timer_drift")) {
    period_ns += 800000;
  }
  return __real_port_timer_start(timer, period_ns, tick);
}

WRAP(void, port_timer_stop, (uint16_t timer))
{
  if (!IS("timer_goes_on")) {
    __real_port_timer_stop(timer);
  }
}

WRAP(uint32_t, port_unique_id, (void))
{
  static uint32_t calls;

  return IS("id_zero") ? 0u : IS("id_changes") ? ++calls : __real_port_unique_id();
}

WRAP(uint32_t, port_stack_peak, (void))
{
  return IS("peak_zero") ? 0u : IS("peak_above") ? 1000000u : __real_port_stack_peak();
}

#ifdef HAS_LINK
static bool is_down;
static bool was_down;

void selftest_set_link(bool is_up);

void selftest_set_link(bool is_up)
{
  is_down = !is_up;
  was_down = true;
}
#else
enum { is_down = 0, was_down = 0 };
#endif

WRAP(bool, port_udp_open, (port_udp_t * udp, const char * host, uint16_t port))
{
  if (was_down && IS("link_refuses")) {
    return false;
  }
  if (IS("udp_takes_all") || IS("udp_none")) {
    return IS("udp_takes_all");
  }
  return __real_port_udp_open(udp, host, port);
}

WRAP(bool, port_udp_send, (port_udp_t * udp, const uint8_t * data, size_t size))
{
  static bool is_broken;

  is_broken = is_broken || (size == 0u && IS("udp_breaks"));
  if (is_down && IS("link_send_waits")) {
    __real_port_sleep_ms(50);
  }
  if (is_down || (was_down && IS("link_stays_down"))) {
    return is_down && IS("link_takes");
  }
  return !is_broken && __real_port_udp_send(udp, data, IS("udp_cuts") && size > 20u ? size - 1u : size);
}

WRAP(int32_t, port_udp_receive, (port_udp_t * udp, uint8_t * buffer, size_t capacity))
{
  int32_t size;

  if (IS("udp_waits") || (is_down && IS("link_receive_waits"))) {
    __real_port_sleep_ms(50);
  }
  if (is_down) {
    return IS("link_invents") ? 5 : 0;
  }
  size = __real_port_udp_receive(udp, buffer, capacity);
  if (IS("udp_invents") && size == 0) {
    return 5;
  }
  return IS("udp_fits") && size < 0 ? (int32_t)capacity : size;
}

WRAP(bool, port_tcp_open, (port_tcp_t * tcp, const char * host, uint16_t port))
{
  if (was_down && IS("link_refuses")) {
    return false;
  }
  return __real_port_tcp_open(tcp, IS("tcp_takes_all") ? "127.0.0.1" : host, port);
}

WRAP(int32_t, port_tcp_send, (port_tcp_t * tcp, const uint8_t * data, size_t size))
{
  int32_t result;

  if (is_down && IS("link_send_waits")) {
    __real_port_sleep_ms(50);
  }
  if (is_down || (was_down && IS("link_stays_down"))) {
    return is_down && IS("link_takes") ? (int32_t)size : 0;
  }
  result = __real_port_tcp_send(tcp, data, size);
  return IS("tcp_invents") && result < 0 ? (int32_t)size : result;
}

WRAP(int32_t, port_tcp_receive, (port_tcp_t * tcp, uint8_t * buffer, size_t capacity))
{
  if (IS("tcp_waits") || (is_down && IS("link_receive_waits"))) {
    __real_port_sleep_ms(50);
  }
  if (is_down) {
    return IS("link_invents") ? 5 : IS("link_closes") ? -1 : 0;
  }
  return __real_port_tcp_receive(tcp, buffer, capacity);
}

WRAP(bool, port_multicast_open, (port_multicast_t * multicast))
{
  return !IS("multicast_none") && __real_port_multicast_open(multicast);
}

WRAP(
  bool, port_multicast_send,
  (port_multicast_t * multicast, const char * group, uint16_t port, const uint8_t * data, size_t size))
{
  if (IS("multicast_takes_all") || IS("multicast_refuses")) {
    return IS("multicast_takes_all");
  }
  return __real_port_multicast_send(multicast, group, port, data, size);
}

WRAP(
  size_t, port_multicast_receive,
  (port_multicast_t * multicast, uint8_t * buffer, size_t capacity, uint8_t * sender))
{
  if (IS("multicast_waits")) {
    __real_port_sleep_ms(50);
  }
  return IS("multicast_invents") ? capacity : __real_port_multicast_receive(multicast, buffer, capacity, sender);
}

#ifdef HAS_STORAGE
WRAP(bool, port_storage_erase, (uint32_t slot))
{
  return !IS("storage_none") && __real_port_storage_erase(slot);
}

WRAP(bool, port_storage_write, (uint32_t slot, uint32_t offset, const uint8_t * bytes, uint32_t size))
{
  static uint32_t calls;

  ++calls;
  if (IS("storage_not_erased") && calls > 2u) {
    return true; /* the bits that were cleared stay */
  }
  return __real_port_storage_write(slot, offset, bytes, IS("storage_cuts") && offset != 0u ? 8u : size);
}
#endif

WRAP(bool, port_serial_open, (port_serial_t * serial, const char * device, uint32_t baud))
{
  static uint32_t calls;

  ++calls;
  return !IS("serial_none") && !(IS("serial_once") && calls > 1u) && !(was_down && IS("link_refuses")) &&
         __real_port_serial_open(serial, device, baud);
}

WRAP(size_t, port_serial_room, (port_serial_t * serial))
{
  return IS("serial_full") ? 0u : __real_port_serial_room(serial);
}

WRAP(bool, port_serial_write, (port_serial_t * serial, const uint8_t * data, size_t size))
{
  uint8_t bytes[1024];

  if (is_down && IS("link_send_waits")) {
    __real_port_sleep_ms(50);
  }
  if (is_down || (was_down && IS("link_stays_down"))) {
    return is_down && IS("link_takes");
  }
  if (IS("serial_refuses") || (size == 0u && IS("serial_refuses_nothing"))) {
    return false;
  }
  (void)memcpy(bytes, data, size);
  if (IS("serial_flips") && size > 20u) {
    bytes[20] ^= 1u;
  }
  return __real_port_serial_write(serial, bytes, size);
}

WRAP(bool, port_serial_is_idle, (port_serial_t * serial))
{
  return !IS("serial_busy") && __real_port_serial_is_idle(serial);
}

WRAP(size_t, port_serial_read, (port_serial_t * serial, uint8_t * buffer, size_t capacity))
{
  if (IS("serial_waits") || (is_down && IS("link_receive_waits"))) {
    __real_port_sleep_ms(50);
  }
  if (is_down) {
    return IS("link_invents") ? 5u : 0u;
  }
  return __real_port_serial_read(serial, buffer, capacity);
}

#ifdef HAS_CAN
WRAP(bool, port_can_open, (port_can_t * can, const char * device, uint32_t id))
{
  static uint32_t calls;

  ++calls;
  if (was_down && IS("link_refuses")) {
    return false;
  }
  return !IS("can_none") && !(IS("can_once") && calls > 1u) && __real_port_can_open(can, device, id);
}

WRAP(bool, port_can_send, (port_can_t * can, const uint8_t * data, size_t size))
{
  uint8_t bytes[PORT_CAN_DATA];

  if (IS("can_refuses")) {
    return false;
  }
  if (IS("can_send_waits") || (is_down && IS("link_send_waits"))) {
    __real_port_sleep_ms(50);
  }
  if (is_down || (was_down && IS("link_stays_down"))) {
    return is_down && IS("link_takes");
  }
  (void)memcpy(bytes, data, size);
  if (IS("can_flips") && size > 20u) {
    bytes[20] ^= 1u;
  }
  return __real_port_can_send(can, bytes, IS("can_cuts") && size > 8u ? 8u : size);
}

WRAP(size_t, port_can_receive, (port_can_t * can, uint8_t * data))
{
  if (IS("can_waits") || (is_down && IS("link_receive_waits"))) {
    __real_port_sleep_ms(50);
  }
  if (is_down) {
    return IS("link_invents") ? 8u : 0u;
  }
  return IS("can_invents") ? 8u : __real_port_can_receive(can, data);
}
#endif

#ifdef HAS_TASKS
static pthread_mutex_t plain = PTHREAD_MUTEX_INITIALIZER;
static __thread uint32_t depth;

WRAP(void, port_lock, (void))
{
  if (IS("lock_none")) {
    return;
  }
  if (IS("lock_once")) {
    (void)pthread_mutex_lock(&plain);
    return;
  }
  if (IS("lock_plain")) { /* recursive, without inheritance */
    if (depth++ == 0u) {
      (void)pthread_mutex_lock(&plain);
    }
    return;
  }
  __real_port_lock();
}

WRAP(void, port_unlock, (void))
{
  if (IS("lock_plain") && --depth == 0u) {
    (void)pthread_mutex_unlock(&plain);
  }
  if (!IS("lock_plain") && !IS("lock_none") && !IS("lock_once")) {
    __real_port_unlock();
  }
}

static bool has_other;
static uint32_t restarts; /* of a task, while there is another one */

WRAP(bool, port_task_create, (uint8_t task, const port_task_t * setting))
{
  if (task == 1u) {
    has_other = true;
  } else if (task == 0u && has_other) {
    ++restarts;
  } else {
    /* of other checks */
  }
  return !IS("task_none") && !(IS("restart_refused") && restarts == 2u) && __real_port_task_create(task, setting);
}

WRAP(uint8_t, port_task_self, (void))
{
  const uint8_t self = __real_port_task_self();

  if (IS("self_wrong") || (IS("restart_self") && restarts == 3u && self == 0u)) {
    return 9;
  }
  return IS("self_everywhere") && self == (uint8_t)PORT_TASK_NONE ? 0u : self;
}

WRAP(void, port_task_set, (uint8_t task))
{
  static uint32_t calls;

  ++calls;
  if (!(IS("event_first_lost") && calls == 1u) && !(IS("event_second_lost") && calls == 2u)) {
    __real_port_task_set(task);
  }
}

WRAP(void, port_task_wait, (uint8_t task, uint32_t timeout_ms))
{
  if (IS("task_wait_never")) {
    return;
  }
  if (IS("task_wait_long")) {
    __real_port_sleep_ms(60);
  }
  __real_port_task_wait(task, timeout_ms);
}

WRAP(uint32_t, port_task_time_us, (void))
{
  static uint32_t calls;
  const uint32_t now = __real_port_task_time_us();

  if (IS("task_time_back")) {
    return ++calls % 50u == 0u ? now - 100000u : now;
  }
  if (IS("task_time_ticks")) {
    return now / 5000u * 5000u;
  }
  return IS("task_time_slow") ? now / 2u : IS("task_time_coarse") ? now / 50000u * 50000u : now;
}

WRAP(void, port_task_sleep_until, (uint32_t time_us))
{
  static uint32_t calls;
  const uint32_t left_us = time_us - port_task_time_us();

  ++calls;
  if (IS("restart_stalls") && restarts == 3u) {
    __real_port_sleep_ms(300);
  }
  if (IS("release_early")) {
    time_us -= 500u;
  }
  if (IS("release_late")) {
    time_us += 15000u;
  }
  if (IS("release_drift")) {
    time_us += calls * 200u;
  }
  if (IS("release_past") && left_us > (uint32_t)INT32_MAX) {
    __real_port_sleep_ms(300);
  }
  __real_port_task_sleep_until(time_us);
}

WRAP(uint32_t, port_task_stack_peak, (uint8_t task))
{
  return IS("task_peak_zero") ? 0u : IS("task_peak_above") ? 10000000u : __real_port_task_stack_peak(task);
}
#endif

#ifdef HAS_DECODER
static const microros_message_type_t * real;

static uint32_t wrong_encode(const void * message, uint8_t * body, cdr_fault_t * fault)
{
  const uint32_t size = real->encode(message, body, fault);

  if (IS("type_encode")) {
    body[size - 1u] ^= 1u;
  }
  return IS("type_encode_refuses") ? 0u : size;
}

static uint32_t wrong_size(const void * message, cdr_fault_t * fault)
{
  return real->encoded_size(message, fault) + (IS("type_size") ? 1u : 0u);
}

static void wrong_decode(cdr_in_t * in, void * message)
{
  if (IS("type_order")) {
    in->swap = false;
  }
  real->decode(in, message);
  if (IS("type_decode")) {
    ((uint8_t *)message)[0] ^= 1u;
  }
  if (IS("type_part")) {
    in->failed = false;
  }
  if (IS("type_refuses")) {
    in->failed = true;
  }
}

WRAP(
  const rosidl_message_type_support_t *,
  rosidl_typesupport_c__get_message_type_support_handle__std_msgs__msg__Int32, (void))
{
  static microros_message_type_t type;
  static rosidl_message_type_support_t handle;

  handle = *__real_rosidl_typesupport_c__get_message_type_support_handle__std_msgs__msg__Int32();
  real = handle.data;
  type = *real;
  type.encode = wrong_encode;
  type.encoded_size = wrong_size;
  type.decode = wrong_decode;
  type.max_encoded_size = IS("type_largest") ? 3u : type.max_encoded_size;
  handle.data = &type;
  return &handle;
}
#endif
