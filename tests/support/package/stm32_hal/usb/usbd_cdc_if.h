/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of the file usbd_cdc_if.h that STM32CubeMX generates. */
#ifndef USBD_CDC_IF_H
#define USBD_CDC_IF_H

#include "usbd_cdc.h"

extern USBD_CDC_ItfTypeDef USBD_Interface_fops_FS;
extern USBD_CDC_ItfTypeDef USBD_Interface_fops_HS;
uint8_t CDC_Transmit_FS(uint8_t * data, uint16_t size);
uint8_t CDC_Transmit_HS(uint8_t * data, uint16_t size);

#endif /* USBD_CDC_IF_H */
