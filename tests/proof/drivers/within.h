/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Put before files that copy into a member of the client (-include): the analyzer sees one object, the client, so that a
 * copy beyond the member would be none for it. And what the reliable input hands on goes to the driver.
 */
#ifndef WITHIN_H
#define WITHIN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "microros/xrce_session.h"

void proof_copy(void * to, const void * from, size_t size);
bool proof_hand_on(xrce_client_t * client, const uint8_t * message, size_t size, uint32_t now);
void proof_sample(xrce_client_t * client, const uint8_t * payload, size_t size, uint8_t flags, uint32_t now);

#define memcpy(to, from, size) proof_copy((to), (from), (size))
#define xrce_session_take_submessages proof_hand_on

#endif /* WITHIN_H */
