/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions that sealed messages need. The application provides the first one, and with `seal: application` all of
 * them; `seal: psa` has the others over the PSA Crypto API. They are called with the lock of the library, from the
 * task that sends or receives, and must not call the library. Each returns false if it failed; nothing that it wrote
 * is used then.
 */
#ifndef MICROROS_SEAL_H
#define MICROROS_SEAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { MICROROS_SEAL_KEY = 32, MICROROS_SEAL_TAG = 16 };

/*
 * Writes the pre-shared key of this client: 32 random bytes that the agent has under `client_key`. The library wipes
 * its copy as soon as the handshake has used it. */
bool microros_seal_psk(uint32_t client_key, uint8_t psk[MICROROS_SEAL_KEY]);

/* Writes `size` bytes of a generator that is fit for keys. */
bool microros_seal_random(uint8_t * bytes, size_t size);

/*
 * Encrypts `size` bytes (0 or more) by ChaCha20-Poly1305 (RFC 8439) and writes them and the tag of 16 bytes. The nonce
 * of 12 bytes is 4 zero bytes and `nonce` in little endian. `additional` is authenticated only. Buffers do not overlap.
 */
bool microros_seal_seal(
  const uint8_t key[MICROROS_SEAL_KEY], uint64_t nonce, const uint8_t * additional, size_t additional_size,
  const uint8_t * plain, size_t size, uint8_t * sealed);

/* The reverse: `size` is that of the plain bytes, `sealed` has the tag after them. False: forged. */
bool microros_seal_open(
  const uint8_t key[MICROROS_SEAL_KEY], uint64_t nonce, const uint8_t * additional, size_t additional_size,
  const uint8_t * sealed, size_t size, uint8_t * plain);

/* Writes SHA-256 (FIPS 180-4) of two parts, one after the other. `digest` may be the first part; `second` may be NULL
 * with a size of 0. */
bool microros_seal_hash(
  const uint8_t * first, size_t first_size, const uint8_t * second, size_t second_size,
  uint8_t digest[MICROROS_SEAL_KEY]);

/* Writes X25519 (RFC 7748) of a secret, which it clamps, and a point. */
bool microros_seal_agree(
  const uint8_t secret[MICROROS_SEAL_KEY], const uint8_t point[MICROROS_SEAL_KEY],
  uint8_t shared[MICROROS_SEAL_KEY]);

#ifdef __cplusplus
}
#endif

#endif /* MICROROS_SEAL_H */
