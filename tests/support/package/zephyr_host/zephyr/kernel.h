/* SPDX-License-Identifier: Apache-2.0 */
/* The kernel of Zephyr that the package calls, over threads and clocks of this computer (kernel.c). A tick is 0.1 ms. */
#ifndef HOST_ZEPHYR_KERNEL_H
#define HOST_ZEPHYR_KERNEL_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define CONFIG_MULTITHREADING 1
#define CONFIG_TIMEOUT_64BIT 1
#define CONFIG_PRIORITY_CEILING -127
#define CONFIG_UART_INTERRUPT_DRIVEN 1
#define CONFIG_RING_BUFFER 1
#define CONFIG_HWINFO 1

typedef struct k_timeout_t {
  int64_t ticks; /* negative: forever */
  bool is_absolute;
} k_timeout_t;

#define K_FOREVER ((k_timeout_t){-1, false})
#define K_MSEC(ms) ((k_timeout_t){(int64_t)(ms) * 10, false})
#define K_TIMEOUT_ABS_TICKS(time) ((k_timeout_t){(time), true})

int64_t k_uptime_ticks(void);
uint32_t k_uptime_get_32(void);
uint64_t k_ticks_to_ns_floor64(uint64_t ticks);
uint64_t k_ms_to_ticks_ceil64(uint64_t ms);
int32_t k_sleep(k_timeout_t timeout);
int32_t k_msleep(int32_t ms);
void k_yield(void);

struct k_spinlock {
  int reserved;
};
typedef struct k_spinlock_key_t {
  int reserved;
} k_spinlock_key_t;

k_spinlock_key_t k_spin_lock(struct k_spinlock * lock);
void k_spin_unlock(struct k_spinlock * lock, k_spinlock_key_t key);

struct k_mutex {
  pthread_mutex_t mutex;
};
#define K_MUTEX_DEFINE(name) struct k_mutex name = {PTHREAD_RECURSIVE_MUTEX_INITIALIZER_NP}

int k_mutex_lock(struct k_mutex * mutex, k_timeout_t timeout);
int k_mutex_unlock(struct k_mutex * mutex);

struct k_sem {
  unsigned int count;
  unsigned int limit;
};
#define K_SEM_DEFINE(name, initial, most) struct k_sem name = {initial, most}

int k_sem_take(struct k_sem * sem, k_timeout_t timeout);
void k_sem_give(struct k_sem * sem);
void k_sem_reset(struct k_sem * sem);

#endif /* HOST_ZEPHYR_KERNEL_H */
