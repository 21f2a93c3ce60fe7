/* SPDX-License-Identifier: Apache-2.0 */
/* Section numbers are those of The Noise Protocol Framework, revision 34. */
#include "microros/xrce_noise.h"

#include <string.h>

enum { KEY = MICROROS_SEAL_KEY, BLOCK = 64, INNER = 0x36, OUTER = 0x5c };

void xrce_noise_wipe(uint8_t * bytes, size_t size)
{
  volatile uint8_t * at = bytes;

  for (size_t i = 0; i < size; ++i) { /* at most BLOCK rounds: nothing secret is longer */
    at[i] = 0;
  }
}

void xrce_noise_clear(xrce_noise_t * noise)
{
  xrce_noise_wipe(noise->hash, KEY);
  xrce_noise_wipe(noise->chain, KEY);
  xrce_noise_wipe(noise->key, KEY);
  xrce_noise_wipe(noise->secret, KEY);
}

static void noise_pad(uint8_t * block, const uint8_t * key, uint8_t pattern)
{
  (void)memset(block, (int)pattern, BLOCK);
  for (size_t i = 0; i < (size_t)KEY; ++i) {
    block[i] = (uint8_t)(block[i] ^ key[i]);
  }
}

/* HMAC-SHA256 (RFC 2104) with a key of 32 bytes. `digest` may be the key, and may be in `data`. */
static bool noise_hmac(const uint8_t * key, const uint8_t * data, size_t size, uint8_t * digest)
{
  uint8_t block[BLOCK];
  uint8_t inner[KEY];
  bool done;

  noise_pad(block, key, INNER);
  done = microros_seal_hash(block, sizeof(block), data, size, inner);
  noise_pad(block, key, OUTER);
  done = done && microros_seal_hash(block, sizeof(block), inner, sizeof(inner), digest);
  xrce_noise_wipe(block, sizeof(block));
  xrce_noise_wipe(inner, sizeof(inner));
  return done;
}

/* 4.3, HKDF: replaces the chaining key, and writes one more output or two. `third` may be NULL. */
static bool noise_derive(
  uint8_t * chain, const uint8_t * input, size_t size, uint8_t * second, uint8_t * third)
{
  uint8_t root[KEY];
  uint8_t data[KEY + 1];
  const uint8_t one = 1;
  bool done = noise_hmac(chain, input, size, root) && noise_hmac(root, &one, 1, chain);

  (void)memcpy(data, chain, KEY);
  data[KEY] = 2;
  done = done && noise_hmac(root, data, sizeof(data), second);
  if (third != NULL) {
    (void)memcpy(data, second, KEY);
    data[KEY] = 3;
    done = done && noise_hmac(root, data, sizeof(data), third);
  }
  xrce_noise_wipe(root, sizeof(root));
  xrce_noise_wipe(data, sizeof(data));
  return done;
}

/* 5.2, MixHash. */
static bool noise_mix_hash(xrce_noise_t * noise, const uint8_t * data, size_t size)
{
  return microros_seal_hash(noise->hash, KEY, data, size, noise->hash);
}

/* 5.2, MixKey. */
static bool noise_mix_key(xrce_noise_t * noise, const uint8_t * input)
{
  return noise_derive(noise->chain, input, KEY, noise->key, NULL);
}

/* 9.2: with a pre-shared key an ephemeral key is mixed into both. */
static bool noise_mix_ephemeral(xrce_noise_t * noise, const uint8_t * point)
{
  return noise_mix_hash(noise, point, KEY) && noise_mix_key(noise, point);
}

/* 5.2, MixKeyAndHash. */
static bool noise_mix_psk(xrce_noise_t * noise, const uint8_t * psk)
{
  uint8_t mixed[KEY];
  const bool done =
    noise_derive(noise->chain, psk, KEY, mixed, noise->key) && noise_mix_hash(noise, mixed, sizeof(mixed));

  xrce_noise_wipe(mixed, sizeof(mixed));
  return done;
}

/* 5.2, InitializeSymmetric: a name longer than a digest is hashed. */
static bool noise_initialize(xrce_noise_t * noise, const uint8_t * prologue, size_t size)
{
  static const uint8_t name[] = {'N', 'o', 'i', 's', 'e', '_', 'N', 'N', 'p', 's', 'k', '0',
                                 '_', '2', '5', '5', '1', '9', '_', 'C', 'h', 'a', 'C', 'h',
                                 'a', 'P', 'o', 'l', 'y', '_', 'S', 'H', 'A', '2', '5', '6'};
  const bool done = microros_seal_hash(name, sizeof(name), NULL, 0, noise->hash);

  (void)memcpy(noise->chain, noise->hash, KEY);
  return done && noise_mix_hash(noise, prologue, size);
}

bool xrce_noise_begin(
  xrce_noise_t * noise, const uint8_t * psk, const uint8_t * prologue, size_t prologue_size,
  uint8_t * message)
{
  uint8_t base[KEY]; /* RFC 7748, 4.1: the point 9 */
  uint8_t * tag = &message[KEY];

  (void)memset(base, 0, sizeof(base));
  base[0] = 9;

  return noise_initialize(noise, prologue, prologue_size) && noise_mix_psk(noise, psk) &&
         microros_seal_random(noise->secret, KEY) && microros_seal_agree(noise->secret, base, message) &&
         noise_mix_ephemeral(noise, message) &&
         microros_seal_seal(noise->key, 0, noise->hash, KEY, message, 0, tag) &&
         noise_mix_hash(noise, tag, MICROROS_SEAL_TAG);
}

/* RFC 7748, 6.1: a point of small order gives zeros, whatever the secret. */
static bool noise_is_zero(const uint8_t * bytes)
{
  uint8_t any = 0;

  for (size_t i = 0; i < (size_t)KEY; ++i) {
    any = (uint8_t)(any | bytes[i]);
  }
  return any == 0u;
}

static bool noise_agree(xrce_noise_t * noise, const uint8_t * point)
{
  uint8_t shared[KEY];
  const bool done = microros_seal_agree(noise->secret, point, shared) && !noise_is_zero(shared) &&
                    noise_mix_key(noise, shared);

  xrce_noise_wipe(shared, sizeof(shared));
  return done;
}

bool xrce_noise_finish(
  const xrce_noise_t * noise, const uint8_t * message, uint8_t * sending, uint8_t * receiving)
{
  xrce_noise_t trial;
  uint8_t none = 0;
  bool done;

  trial = *noise; /* a forged message must not end the handshake */
  done = noise_mix_ephemeral(&trial, message) && noise_agree(&trial, message) &&
         microros_seal_open(trial.key, 0, trial.hash, KEY, &message[KEY], 0, &none);
  if (done) { /* 5.2, Split */
    (void)memcpy(sending, trial.chain, KEY);
    done = noise_derive(sending, &none, 0, receiving, NULL);
  }
  xrce_noise_clear(&trial);
  return done;
}
