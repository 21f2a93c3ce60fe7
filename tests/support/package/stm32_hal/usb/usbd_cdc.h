/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of STM32Cube's USB device library that the package `stm32cube` calls. */
#ifndef USBD_CDC_H
#define USBD_CDC_H

#include <stdint.h>

#define CDC_DATA_FS_MAX_PACKET_SIZE 64U
#define CDC_DATA_HS_MAX_PACKET_SIZE 512U

typedef enum { USBD_OK, USBD_BUSY, USBD_EMEM, USBD_FAIL } USBD_StatusTypeDef;
#define USBD_STATE_DEFAULT 0x01U
#define USBD_STATE_CONFIGURED 0x03U
typedef struct {
  volatile uint8_t dev_state;
} USBD_HandleTypeDef;
typedef struct {
  int8_t (*Init)(void);
  int8_t (*DeInit)(void);
  int8_t (*Control)(uint8_t command, uint8_t * data, uint16_t size);
  int8_t (*Receive)(uint8_t * data, uint32_t * size);
  int8_t (*TransmitCplt)(uint8_t * data, uint32_t * size, uint8_t endpoint);
} USBD_CDC_ItfTypeDef;

uint8_t USBD_CDC_SetRxBuffer(USBD_HandleTypeDef * device, uint8_t * data);
uint8_t USBD_CDC_ReceivePacket(USBD_HandleTypeDef * device);

#endif /* USBD_CDC_H */
