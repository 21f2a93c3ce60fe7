/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The initiator of Noise_NNpsk0_25519_ChaChaPoly_SHA256 (The Noise Protocol Framework, revision 34) with empty
 * payloads. Internal. */
#ifndef MICROROS_XRCE_NOISE_H
#define MICROROS_XRCE_NOISE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "microros/seal.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Size of both messages: an ephemeral public key, and the tag of an empty payload. */
enum { XRCE_NOISE_MESSAGE = MICROROS_SEAL_KEY + MICROROS_SEAL_TAG };

/* The state of a handshake: h, ck and k of the framework, and the secret of the ephemeral key. */
typedef struct xrce_noise_t {
  uint8_t hash[MICROROS_SEAL_KEY];
  uint8_t chain[MICROROS_SEAL_KEY];
  uint8_t key[MICROROS_SEAL_KEY];
  uint8_t secret[MICROROS_SEAL_KEY];
} xrce_noise_t;

/* Overwrites bytes, also where nothing reads them any more. */
void xrce_noise_wipe(uint8_t * bytes, size_t size);

/* Overwrites a handshake. */
void xrce_noise_clear(xrce_noise_t * noise);

/* Writes the first message, `-> psk, e`. Returns false if a function of the application failed. */
bool xrce_noise_begin(
  xrce_noise_t * noise, const uint8_t * psk, const uint8_t * prologue, size_t prologue_size,
  uint8_t * message);

/*
 * Reads the second message, `<- e, ee`, and writes the keys of both directions. Returns false, with `noise` as before,
 * if it is forged or a function of the application failed. */
bool xrce_noise_finish(
  const xrce_noise_t * noise, const uint8_t * message, uint8_t * sending, uint8_t * receiving);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_XRCE_NOISE_H */
