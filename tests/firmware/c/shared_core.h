/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The shared memory of two images on QEMU's mps2-an521: two Cortex-M33 of an SSE-200. Its last SSRAM belongs to neither
 * linker script, and both cores see it at one address. */
#ifndef SHARED_CORE_H
#define SHARED_CORE_H

#include <microros/port_shared.h>

#include <stdint.h>

enum { SHARED_BYTES = 0x1000 };

static volatile uint32_t * const shared_memory = (volatile uint32_t *)0x38200000u;

uint32_t * port_shared_region(size_t bytes)
{
  return bytes <= (size_t)SHARED_BYTES ? (uint32_t *)(uintptr_t)shared_memory : NULL;
}

void port_shared_barrier(void)
{
  __asm volatile("dmb" ::: "memory");
}

/* The other core looks every millisecond. */
void port_shared_notify(void)
{
}

#endif /* SHARED_CORE_H */
