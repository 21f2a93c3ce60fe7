/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The transport of a project of STM32CubeMX. Compile one of the files next to this header: each has the four functions.
 *
 * | file                | rmw_uros_set_custom_transport(…)   | in STM32CubeMX                                           |
 * | dma_transport.c     | true, &huart3                      | UART with DMA for Rx (circular) and Tx, global interrupt |
 * | it_transport.c      | true, &huart3                      | UART with global interrupt                               |
 * | usb_cdc_transport.c | true, NULL                         | USB device, Virtual Port Com                             |
 * | udp_transport.c     | false, "192.168.1.10" (the agent)  | Ethernet, lwIP with sockets, FreeRTOS                    |
 *
 * Where all files of a folder are compiled (STM32CubeIDE), MICROROS_TRANSPORT chooses one: define it for the compiler as
 * MICROROS_TRANSPORT_DMA, MICROROS_TRANSPORT_IT, MICROROS_TRANSPORT_USB_CDC or MICROROS_TRANSPORT_UDP.
 *
 * There is one line. Its functions are called by one task at a time.
 */
#ifndef CUBEMX_TRANSPORT_H
#define CUBEMX_TRANSPORT_H

#include <uxr/client/transport.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define MICROROS_TRANSPORT_DMA 1
#define MICROROS_TRANSPORT_IT 2
#define MICROROS_TRANSPORT_USB_CDC 3
#define MICROROS_TRANSPORT_UDP 4

/* Bytes that wait until the library reads them, and bytes that wait for the line. Multiples of 32. */
#ifndef MICROROS_RX_SIZE
#define MICROROS_RX_SIZE 2048
#endif
#ifndef MICROROS_TX_SIZE
#define MICROROS_TX_SIZE 512
#endif

/* The longest wait of a write until the line takes its bytes, milliseconds. */
#ifndef MICROROS_WRITE_TIMEOUT_MS
#define MICROROS_WRITE_TIMEOUT_MS 100
#endif

/* Where the buffers of DMA are: `__attribute__((section(".dma_buffers")))` for memory that the DMA reaches, which is
 * not that of DTCM in an STM32H7. */
#ifndef MICROROS_DMA_MEMORY
#define MICROROS_DMA_MEMORY
#endif

#ifdef __cplusplus
extern "C" {
#endif

bool cubemx_transport_open(struct uxrCustomTransport * transport);
bool cubemx_transport_close(struct uxrCustomTransport * transport);
size_t cubemx_transport_write(
  struct uxrCustomTransport * transport, const uint8_t * buf, size_t len, uint8_t * err);
size_t cubemx_transport_read(
  struct uxrCustomTransport * transport, uint8_t * buf, size_t len, int timeout, uint8_t * err);

#ifdef __cplusplus
}
#endif

#endif /* CUBEMX_TRANSPORT_H */
