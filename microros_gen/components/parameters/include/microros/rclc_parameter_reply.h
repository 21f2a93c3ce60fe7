/* SPDX-License-Identifier: Apache-2.0 */
/* Encoders of the replies, whose message is the server. Internal. */
#ifndef MICROROS_RCLC_PARAMETER_REPLY_H
#define MICROROS_RCLC_PARAMETER_REPLY_H

#include <stdint.h>

#include "microros/message_type.h"

#ifdef __cplusplus
extern "C" {
#endif

uint32_t rclc_parameter_reply_values(const void * message, uint8_t * body, cdr_fault_t * fault);
uint32_t rclc_parameter_reply_types(const void * message, uint8_t * body, cdr_fault_t * fault);
uint32_t rclc_parameter_reply_results(const void * message, uint8_t * body, cdr_fault_t * fault);
uint32_t rclc_parameter_reply_result(const void * message, uint8_t * body, cdr_fault_t * fault);
uint32_t rclc_parameter_reply_list(const void * message, uint8_t * body, cdr_fault_t * fault);
uint32_t rclc_parameter_reply_descriptors(const void * message, uint8_t * body, cdr_fault_t * fault);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_RCLC_PARAMETER_REPLY_H */
