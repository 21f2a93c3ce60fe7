/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of Zephyr that the port calls: for a check of its syntax, not of what it does. */
#ifndef STAND_IN_ZEPHYR_KERNEL_H
#define STAND_IN_ZEPHYR_KERNEL_H

#include "zephyr/autoconf.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct k_timeout_t {
  int64_t ticks;
} k_timeout_t;

k_timeout_t kernel_timeout(int64_t ticks);

#define K_NO_WAIT kernel_timeout(0)
#define K_FOREVER kernel_timeout(-1)
#define K_MSEC(ms) kernel_timeout((int64_t)(ms))
#define K_TICKS(ticks) kernel_timeout(ticks)
#define K_TIMEOUT_ABS_TICKS(ticks) kernel_timeout(ticks)

int64_t k_uptime_ticks(void);
uint32_t k_uptime_get_32(void);
uint64_t k_cycle_get_64(void);
uint64_t k_cyc_to_ns_floor64(uint64_t cycles);
uint64_t k_ticks_to_ns_floor64(uint64_t ticks);
uint64_t k_ms_to_ticks_ceil64(uint64_t ms);
uint64_t k_us_to_ticks_ceil64(uint64_t us);
int32_t k_msleep(int32_t ms);
int32_t k_sleep(k_timeout_t timeout);
void k_yield(void);
bool k_is_in_isr(void);

typedef intptr_t atomic_t;
typedef intptr_t atomic_val_t;

atomic_val_t atomic_get(const atomic_t * target);
atomic_val_t atomic_add(atomic_t * target, atomic_val_t value);

struct k_spinlock {
  uintptr_t reserved;
};
typedef struct k_spinlock_key_t {
  int reserved;
} k_spinlock_key_t;

k_spinlock_key_t k_spin_lock(struct k_spinlock * lock);
void k_spin_unlock(struct k_spinlock * lock, k_spinlock_key_t key);

struct k_mutex {
  void * reserved[5];
};
#define K_MUTEX_DEFINE(name) struct k_mutex name = {{NULL}}

int k_mutex_lock(struct k_mutex * mutex, k_timeout_t timeout);
int k_mutex_unlock(struct k_mutex * mutex);

struct k_sem {
  unsigned int count;
  unsigned int limit;
};
#define K_SEM_DEFINE(name, initial, most) struct k_sem name = {initial, most}

int k_sem_init(struct k_sem * sem, unsigned int initial_count, unsigned int limit);
void k_sem_reset(struct k_sem * sem);
int k_sem_take(struct k_sem * sem, k_timeout_t timeout);
void k_sem_give(struct k_sem * sem);

struct k_work;
typedef void (*k_work_handler_t)(struct k_work * work);

struct k_work {
  k_work_handler_t handler;
};
#define K_WORK_DEFINE(name, function) struct k_work name = {function}

int k_work_submit(struct k_work * work);

struct k_timer;
typedef void (*k_timer_expiry_t)(struct k_timer * timer);
typedef void (*k_timer_stop_t)(struct k_timer * timer);

struct k_timer {
  k_timer_expiry_t expiry;
};

void k_timer_init(struct k_timer * timer, k_timer_expiry_t expiry, k_timer_stop_t stop);
void k_timer_start(struct k_timer * timer, k_timeout_t duration, k_timeout_t period);
void k_timer_stop(struct k_timer * timer);

#define CONTAINER_OF(pointer, type, field) ((type *)(void *)((char *)(pointer) - offsetof(type, field)))

struct k_thread {
  void * reserved[30];
};
typedef struct k_thread * k_tid_t;
typedef struct z_thread_stack_element {
  char data;
} k_thread_stack_t;
typedef void (*k_thread_entry_t)(void * first, void * second, void * third);

#define K_KERNEL_STACK_DEFINE(name, size) struct z_thread_stack_element name[size]
#define K_LOWEST_APPLICATION_THREAD_PRIO (CONFIG_NUM_PREEMPT_PRIORITIES - 1)
#define K_FP_REGS 2u

k_tid_t k_thread_create(
  struct k_thread * thread, k_thread_stack_t * stack, size_t stack_size, k_thread_entry_t entry, void * first,
  void * second, void * third, int priority, uint32_t options, k_timeout_t delay);
void k_thread_priority_set(k_tid_t thread, int prio);
int k_thread_join(struct k_thread * thread, k_timeout_t timeout);
int k_thread_name_set(k_tid_t thread, const char * name);
int k_thread_stack_space_get(const struct k_thread * thread, size_t * unused);
k_tid_t k_current_get(void);

#endif /* STAND_IN_ZEPHYR_KERNEL_H */
