/* SPDX-License-Identifier: Apache-2.0 */
/* The functions of microros/seal.h over the PSA Crypto API 1.0, such as that of Mbed TLS. */
#include "microros/seal.h"

#include <psa/crypto.h>
#include <string.h>

enum { CIPHER_BITS = 256, CURVE_BITS = 255, NONCE = 12, NONCE_COUNTER = 4 };

/* Imports a key for one use. */
static psa_status_t psa_import(
  psa_key_type_t type, size_t bits, psa_algorithm_t algorithm, psa_key_usage_t usage, const uint8_t * key,
  psa_key_id_t * id)
{
  psa_key_attributes_t attributes = PSA_KEY_ATTRIBUTES_INIT;
  psa_status_t status = psa_crypto_init(); /* returns at once when it was called before */

  if (status == PSA_SUCCESS) {
    psa_set_key_type(&attributes, type);
    psa_set_key_bits(&attributes, bits);
    psa_set_key_algorithm(&attributes, algorithm);
    psa_set_key_usage_flags(&attributes, usage);
    status = psa_import_key(&attributes, key, MICROROS_SEAL_KEY, id);
  }
  return status;
}

static void psa_put_nonce(uint8_t * bytes, uint64_t nonce)
{
  uint64_t rest = nonce;

  (void)memset(bytes, 0, NONCE_COUNTER);
  for (uint8_t i = 0; i < 8u; ++i) {
    bytes[NONCE_COUNTER + i] = (uint8_t)(rest & 0xffu);
    rest >>= 8;
  }
}

/* A plain memset of what nobody reads any more may be left out by the compiler. */
static void psa_wipe(uint8_t * secret)
{
  volatile uint8_t * at = secret;

  for (uint8_t i = 0; i < (uint8_t)MICROROS_SEAL_KEY; ++i) {
    at[i] = 0;
  }
}

bool microros_seal_random(uint8_t * bytes, size_t size)
{
  return psa_crypto_init() == PSA_SUCCESS && psa_generate_random(bytes, size) == PSA_SUCCESS;
}

/* Imports a key of the cipher for one use. */
static bool psa_import_cipher(psa_key_usage_t usage, const uint8_t * key, psa_key_id_t * id)
{
  return psa_import(PSA_KEY_TYPE_CHACHA20, CIPHER_BITS, PSA_ALG_CHACHA20_POLY1305, usage, key, id) ==
         PSA_SUCCESS;
}

bool microros_seal_seal(
  const uint8_t key[MICROROS_SEAL_KEY], uint64_t nonce, const uint8_t * additional, size_t additional_size,
  const uint8_t * plain, size_t size, uint8_t * sealed)
{
  const psa_algorithm_t algorithm = PSA_ALG_CHACHA20_POLY1305;
  uint8_t bytes[NONCE];
  psa_key_id_t id = 0;
  size_t written = 0;
  psa_status_t status;

  if (!psa_import_cipher(PSA_KEY_USAGE_ENCRYPT, key, &id)) {
    return false;
  }
  psa_put_nonce(bytes, nonce);
  status = psa_aead_encrypt(
    id, algorithm, bytes, sizeof(bytes), additional, additional_size, plain, size, sealed,
    size + (size_t)MICROROS_SEAL_TAG, &written);
  return psa_destroy_key(id) == PSA_SUCCESS && status == PSA_SUCCESS &&
         written == size + (size_t)MICROROS_SEAL_TAG;
}

bool microros_seal_open(
  const uint8_t key[MICROROS_SEAL_KEY], uint64_t nonce, const uint8_t * additional, size_t additional_size,
  const uint8_t * sealed, size_t size, uint8_t * plain)
{
  const psa_algorithm_t algorithm = PSA_ALG_CHACHA20_POLY1305;
  uint8_t bytes[NONCE];
  psa_key_id_t id = 0;
  size_t written = 0;
  psa_status_t status;

  if (!psa_import_cipher(PSA_KEY_USAGE_DECRYPT, key, &id)) {
    return false;
  }
  psa_put_nonce(bytes, nonce);
  status = psa_aead_decrypt(
    id, algorithm, bytes, sizeof(bytes), additional, additional_size, sealed,
    size + (size_t)MICROROS_SEAL_TAG, plain, size, &written);
  return psa_destroy_key(id) == PSA_SUCCESS && status == PSA_SUCCESS && written == size;
}

bool microros_seal_hash(
  const uint8_t * first, size_t first_size, const uint8_t * second, size_t second_size,
  uint8_t digest[MICROROS_SEAL_KEY])
{
  psa_hash_operation_t operation = PSA_HASH_OPERATION_INIT;
  size_t written = 0;
  bool done = psa_crypto_init() == PSA_SUCCESS && psa_hash_setup(&operation, PSA_ALG_SHA_256) == PSA_SUCCESS;

  done = done && psa_hash_update(&operation, first, first_size) == PSA_SUCCESS;
  if (second_size > 0u) {
    done = done && psa_hash_update(&operation, second, second_size) == PSA_SUCCESS;
  }
  done = done && psa_hash_finish(&operation, digest, MICROROS_SEAL_KEY, &written) == PSA_SUCCESS;
  if (!done) {
    (void)psa_hash_abort(&operation); /* nothing else can be done with an operation that failed */
  }
  return done && written == (size_t)MICROROS_SEAL_KEY;
}

bool microros_seal_agree(
  const uint8_t secret[MICROROS_SEAL_KEY], const uint8_t point[MICROROS_SEAL_KEY],
  uint8_t shared[MICROROS_SEAL_KEY])
{
  const psa_key_type_t type = PSA_KEY_TYPE_ECC_KEY_PAIR(PSA_ECC_FAMILY_MONTGOMERY);
  psa_key_id_t id = 0;
  size_t written = 0;
  uint8_t clamped[MICROROS_SEAL_KEY]; /* RFC 7748, 5: an implementation may refuse others */
  psa_status_t status;

  (void)memcpy(clamped, secret, sizeof(clamped));
  clamped[0] &= 0xf8u;
  clamped[MICROROS_SEAL_KEY - 1] = (uint8_t)((clamped[MICROROS_SEAL_KEY - 1] & 0x7fu) | 0x40u);
  status = psa_import(type, CURVE_BITS, PSA_ALG_ECDH, PSA_KEY_USAGE_DERIVE, clamped, &id);
  psa_wipe(clamped);
  if (status != PSA_SUCCESS) {
    return false;
  }
  status =
    psa_raw_key_agreement(PSA_ALG_ECDH, id, point, MICROROS_SEAL_KEY, shared, MICROROS_SEAL_KEY, &written);
  return psa_destroy_key(id) == PSA_SUCCESS && status == PSA_SUCCESS && written == (size_t)MICROROS_SEAL_KEY;
}
