/* SPDX-License-Identifier: Apache-2.0 */
/* Functions of Zephyr over this computer. The UART is the terminal that ZEPHYR_LINE names; a thread is its interrupt. */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include <zephyr/drivers/hwinfo.h>
#include <zephyr/drivers/uart.h>
#include <zephyr/kernel.h>
#include <zephyr/sys/ring_buffer.h>

enum { NS_PER_TICK = 100000, TICKS_PER_S = 10000, FIFO = 16 };

static pthread_mutex_t guard = PTHREAD_MUTEX_INITIALIZER;
static pthread_mutex_t ring_guard = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t given = PTHREAD_COND_INITIALIZER;

int64_t k_uptime_ticks(void)
{
  struct timespec now;

  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * TICKS_PER_S + now.tv_nsec / NS_PER_TICK;
}

uint32_t k_uptime_get_32(void)
{
  return (uint32_t)(k_uptime_ticks() / 10);
}

uint64_t k_ticks_to_ns_floor64(uint64_t ticks)
{
  return ticks * NS_PER_TICK;
}

uint64_t k_ms_to_ticks_ceil64(uint64_t ms)
{
  return ms * 10u;
}

int32_t k_sleep(k_timeout_t timeout)
{
  const int64_t left = timeout.is_absolute ? timeout.ticks - k_uptime_ticks() : timeout.ticks;

  return left > 0 ? (int32_t)usleep((useconds_t)left * 100u) : 0;
}

int32_t k_msleep(int32_t ms)
{
  return k_sleep(K_MSEC(ms));
}

void k_yield(void)
{
  (void)sched_yield();
}

k_spinlock_key_t k_spin_lock(struct k_spinlock * lock)
{
  (void)lock;
  (void)pthread_mutex_lock(&guard);
  return (k_spinlock_key_t){0};
}

void k_spin_unlock(struct k_spinlock * lock, k_spinlock_key_t key)
{
  (void)lock;
  (void)key;
  (void)pthread_mutex_unlock(&guard);
}

int k_mutex_lock(struct k_mutex * mutex, k_timeout_t timeout)
{
  (void)timeout;
  return pthread_mutex_lock(&mutex->mutex);
}

int k_mutex_unlock(struct k_mutex * mutex)
{
  return pthread_mutex_unlock(&mutex->mutex);
}

int k_sem_take(struct k_sem * sem, k_timeout_t timeout)
{
  struct timespec end;
  int result = 0;
  int64_t ns;

  (void)clock_gettime(CLOCK_REALTIME, &end);
  ns = end.tv_nsec + timeout.ticks * NS_PER_TICK;
  end.tv_sec += ns / 1000000000;
  end.tv_nsec = ns % 1000000000;
  (void)pthread_mutex_lock(&guard);
  while (sem->count == 0u && result == 0) {
    result = timeout.ticks < 0 ? pthread_cond_wait(&given, &guard) : pthread_cond_timedwait(&given, &guard, &end);
  }
  if (sem->count > 0u) {
    --sem->count;
    result = 0;
  }
  (void)pthread_mutex_unlock(&guard);
  return result == 0 ? 0 : -EAGAIN;
}

void k_sem_give(struct k_sem * sem)
{
  (void)pthread_mutex_lock(&guard);
  sem->count += sem->count < sem->limit ? 1u : 0u;
  (void)pthread_cond_broadcast(&given);
  (void)pthread_mutex_unlock(&guard);
}

void k_sem_reset(struct k_sem * sem)
{
  (void)pthread_mutex_lock(&guard);
  sem->count = 0;
  (void)pthread_mutex_unlock(&guard);
}

ssize_t hwinfo_get_device_id(uint8_t * buffer, size_t length)
{
  (void)memset(buffer, 0x5a, length);
  return (ssize_t)length;
}

void ring_buf_init(struct ring_buf * ring, uint32_t size, uint8_t * bytes)
{
  *ring = (struct ring_buf){.bytes = bytes, .size = size};
}

uint32_t ring_buf_put(struct ring_buf * ring, const uint8_t * bytes, uint32_t size)
{
  uint32_t count = 0;

  (void)pthread_mutex_lock(&ring_guard);
  while (count < size && ring->put - ring->got < ring->size) {
    ring->bytes[ring->put++ % ring->size] = bytes[count++];
  }
  (void)pthread_mutex_unlock(&ring_guard);
  return count;
}

uint32_t ring_buf_get(struct ring_buf * ring, uint8_t * bytes, uint32_t size)
{
  uint32_t count = 0;

  (void)pthread_mutex_lock(&ring_guard);
  while (count < size && ring->put != ring->got) {
    bytes[count++] = ring->bytes[ring->got++ % ring->size];
  }
  (void)pthread_mutex_unlock(&ring_guard);
  return count;
}

/* What is contiguous. */
uint32_t ring_buf_get_claim(struct ring_buf * ring, uint8_t ** bytes, uint32_t size)
{
  uint32_t most;

  (void)pthread_mutex_lock(&ring_guard);
  most = ring->size - ring->got % ring->size;
  most = ring->put - ring->got < most ? ring->put - ring->got : most;
  *bytes = &ring->bytes[ring->got % ring->size];
  (void)pthread_mutex_unlock(&ring_guard);
  return most < size ? most : size;
}

int ring_buf_get_finish(struct ring_buf * ring, uint32_t size)
{
  (void)pthread_mutex_lock(&ring_guard);
  ring->got += size;
  (void)pthread_mutex_unlock(&ring_guard);
  return 0;
}

bool ring_buf_is_empty(const struct ring_buf * ring)
{
  bool is_empty;

  (void)pthread_mutex_lock(&ring_guard);
  is_empty = ring->put == ring->got;
  (void)pthread_mutex_unlock(&ring_guard);
  return is_empty;
}

const struct device host_uart = {"uart@0"};
static uart_irq_callback_user_data_t callback;
static void * callback_data;
static pthread_t interrupt;
static int line = -1;
static volatile bool receives;
static volatile bool sends;

static bool is_ready(short events)
{
  struct pollfd waiting = {line, events, 0};

  return poll(&waiting, 1, 0) > 0 && (waiting.revents & events) != 0;
}

static void * interrupts(void * unused)
{
  (void)unused;
  for (;;) {
    if ((receives && is_ready(POLLIN)) || sends) {
      callback(&host_uart, callback_data);
    } else {
      (void)usleep(200);
    }
  }
  return NULL;
}

bool device_is_ready(const struct device * device)
{
  struct termios settings;

  if (line < 0) {
    line = open(getenv("ZEPHYR_LINE"), O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (line >= 0 && tcgetattr(line, &settings) == 0) {
      cfmakeraw(&settings);
      (void)tcsetattr(line, TCSANOW, &settings);
    }
  }
  return device == &host_uart && line >= 0;
}

int uart_irq_callback_user_data_set(
  const struct device * device, uart_irq_callback_user_data_t function, void * user_data)
{
  const bool is_first = callback == NULL;

  (void)device;
  callback = function;
  callback_data = user_data;
  return is_first ? pthread_create(&interrupt, NULL, interrupts, NULL) : 0;
}

void uart_irq_rx_enable(const struct device * device)
{
  (void)device;
  receives = true;
}

void uart_irq_rx_disable(const struct device * device)
{
  (void)device;
  receives = false;
}

void uart_irq_tx_enable(const struct device * device)
{
  (void)device;
  sends = true;
}

void uart_irq_tx_disable(const struct device * device)
{
  (void)device;
  sends = false;
}

int uart_irq_update(const struct device * device)
{
  (void)device;
  return 1;
}

int uart_irq_is_pending(const struct device * device)
{
  return uart_irq_rx_ready(device) > 0 || uart_irq_tx_ready(device) > 0 ? 1 : 0;
}

int uart_irq_rx_ready(const struct device * device)
{
  (void)device;
  return receives && is_ready(POLLIN) ? 1 : 0;
}

int uart_irq_tx_ready(const struct device * device)
{
  (void)device;
  return sends ? 1 : 0;
}

int uart_fifo_read(const struct device * device, uint8_t * bytes, int size)
{
  const ssize_t got = read(line, bytes, (size_t)size);

  (void)device;
  return got > 0 ? (int)got : 0;
}

/* As a device whose FIFO has 16 places. */
int uart_fifo_fill(const struct device * device, const uint8_t * bytes, int size)
{
  const ssize_t sent = write(line, bytes, (size_t)(size < (int)FIFO ? size : (int)FIFO));

  (void)device;
  return sent > 0 ? (int)sent : 0;
}
