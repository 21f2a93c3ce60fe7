/* SPDX-License-Identifier: Apache-2.0 */
/* Declarations of STM32Cube's HAL that the package `stm32cube` calls: for a check of syntax, and for stand-ins. */
#ifndef MAIN_H
#define MAIN_H

#include <stddef.h>
#include <stdint.h>

typedef enum { HAL_OK, HAL_ERROR, HAL_BUSY, HAL_TIMEOUT } HAL_StatusTypeDef;
typedef uint32_t HAL_UART_StateTypeDef;
typedef struct {
  volatile uint32_t * counter;
} DMA_HandleTypeDef;
typedef struct {
  volatile HAL_UART_StateTypeDef gState;
  volatile HAL_UART_StateTypeDef RxState;
  DMA_HandleTypeDef * hdmarx;
} UART_HandleTypeDef;

#define HAL_UART_STATE_READY 0x20u
#define __HAL_DMA_GET_COUNTER(handle) (*(handle)->counter)

uint32_t HAL_GetTick(void);
uint32_t HAL_GetUIDw0(void);
uint32_t HAL_GetUIDw1(void);
uint32_t HAL_GetUIDw2(void);
HAL_StatusTypeDef HAL_UART_Receive_DMA(UART_HandleTypeDef * uart, uint8_t * data, uint16_t size);
HAL_StatusTypeDef HAL_UART_Transmit_DMA(UART_HandleTypeDef * uart, const uint8_t * data, uint16_t size);
HAL_StatusTypeDef HAL_UART_DMAStop(UART_HandleTypeDef * uart);
HAL_StatusTypeDef HAL_UART_Receive_IT(UART_HandleTypeDef * uart, uint8_t * data, uint16_t size);
HAL_StatusTypeDef HAL_UART_Transmit_IT(UART_HandleTypeDef * uart, const uint8_t * data, uint16_t size);
HAL_StatusTypeDef HAL_UART_Abort(UART_HandleTypeDef * uart);
void HAL_UART_RxCpltCallback(UART_HandleTypeDef * uart);

/* Reset flags by family; their numbers are those of this stand-in. */
extern volatile uint32_t stm32_reset_flags;
#define __HAL_RCC_GET_FLAG(flag) ((stm32_reset_flags & (flag)) != 0u ? 1u : 0u)
#define __HAL_RCC_CLEAR_RESET_FLAGS() (stm32_reset_flags = 0u)
#define RCC_FLAG_PINRST 0x01u
#define RCC_FLAG_SFTRST 0x02u
#if defined(STM32_H7)
#define RCC_FLAG_IWDG1RST 0x04u
#define RCC_FLAG_WWDG1RST 0x08u
#define RCC_FLAG_LPWR1RST 0x40u
#else
#define RCC_FLAG_IWDGRST 0x04u
#define RCC_FLAG_WWDGRST 0x08u
#define RCC_FLAG_LPWRRST 0x40u
#endif
#if defined(STM32_G0) || defined(STM32_L4)
#define RCC_FLAG_OBLRST 0x80u
#endif
#if defined(STM32_G0)
#define RCC_FLAG_PWRRST 0x10u
#elif !defined(STM32_L4)
#define RCC_FLAG_PORRST 0x10u
#endif
#if !defined(STM32_F1) && !defined(STM32_G0)
#define RCC_FLAG_BORRST 0x20u
#endif

void __WFI(void);
void __disable_irq(void);
uint32_t __get_PRIMASK(void);
void __set_PRIMASK(uint32_t mask);

#if defined(STM32_HAS_CACHE)
#define __DCACHE_PRESENT 1U
#define SCB_CCR_DC_Msk 0x10000u
typedef struct {
  volatile uint32_t CCR;
} SCB_Type;
extern SCB_Type * const SCB;
void SCB_CleanDCache_by_Addr(volatile void * address, int32_t size);
void SCB_InvalidateDCache_by_Addr(volatile void * address, int32_t size);
#endif

#endif /* MAIN_H */
