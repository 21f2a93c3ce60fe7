/* SPDX-License-Identifier: Apache-2.0 */
/* diagnostic_msgs/msg/DiagnosticArray, written from the tables: no message is in memory. */
#include "microros/cdr.h"
#include "microros/epoch.h"
#include "microros/rcl_diagnosis.h"
#include "microros/text.h"

enum { DIGITS = 11 }; /* of a number of 32 bits with its sign */

typedef struct encode_t {
  uint8_t * body;
  uint32_t position;
  uint32_t values; /* pairs so far */
} encode_t;

static void encode_align(encode_t * out)
{
  while (out->position % 4u != 0u) {
    out->body[out->position] = 0;
    ++out->position;
  }
}

static void encode_number(encode_t * out, uint32_t number)
{
  encode_align(out);
  cdr_put_4(&out->body[out->position], &number);
  out->position += 4u;
}

static void encode_byte(encode_t * out, char byte)
{
  out->body[out->position] = (uint8_t)byte;
  ++out->position;
}

/* Begins a text; encode_text_end gets what this returns. */
static uint32_t encode_text_begin(encode_t * out)
{
  encode_number(out, 0);
  return out->position;
}

static void encode_words(encode_t * out, const char * text)
{
  for (const char * at = text; *at != '\0'; ++at) {
    encode_byte(out, *at);
  }
}

static void encode_digits(encode_t * out, uint32_t number)
{
  char digits[DIGITS];
  uint32_t left = number;
  size_t first = sizeof(digits);

  do {
    --first;
    digits[first] = (char)('0' + (char)(left % 10u));
    left /= 10u;
  } while (left != 0u);
  for (size_t i = first; i < sizeof(digits); ++i) {
    encode_byte(out, digits[i]);
  }
}

static void encode_signed(encode_t * out, int32_t number)
{
  if (number < 0) {
    encode_byte(out, '-');
  }
  encode_digits(out, number < 0 ? 0u - (uint32_t)number : (uint32_t)number);
}

static void encode_text_end(encode_t * out, uint32_t begin)
{
  uint32_t size;

  encode_byte(out, '\0');
  size = out->position - begin;
  cdr_put_4(&out->body[begin - 4u], &size);
}

static void encode_text(encode_t * out, const char * text)
{
  const uint32_t begin = encode_text_begin(out);

  encode_words(out, text);
  encode_text_end(out, begin);
}

/* Seconds and nanoseconds since 1970. Long division, a bit at a time: a division of 64 bits would link a large function. */
static void encode_stamp(encode_t * out)
{
  const uint64_t ns_per_s = 1000000000u;
  const int64_t now = microros_epoch_known_ns();
  uint64_t left = now < 0 ? 0u : (uint64_t)now;
  uint32_t seconds = 0;

  for (uint32_t bit = 32; bit != 0u; --bit) {
    const uint64_t part = ns_per_s << (bit - 1u);

    seconds <<= 1;
    if (left >= part) {
      left -= part;
      ++seconds;
    }
  }
  encode_number(out, seconds);
  encode_number(out, (uint32_t)left);
}

static void encode_key(encode_t * out, const char * key)
{
  encode_text(out, key);
  ++out->values;
}

static void encode_value(encode_t * out, const char * key, int32_t value)
{
  uint32_t begin;

  encode_key(out, key);
  begin = encode_text_begin(out);
  encode_signed(out, value);
  encode_text_end(out, begin);
}

static void encode_row(encode_t * out, const rcl_diagnosis_row_t * row, uint32_t number)
{
  uint32_t begin;

  encode_key(out, row->key);
  begin = encode_text_begin(out);
  if (row->words != NULL) {
    encode_words(out, row->words[number]);
  } else {
    encode_digits(out, number);
  }
  encode_text_end(out, begin);
}

static void encode_pair(encode_t * out, const char * key, const char * text)
{
  encode_key(out, key);
  encode_text(out, text);
}

static void encode_mode(encode_t * out, const rcl_diagnosis_check_t * check, bool waits)
{
  encode_pair(out, "mode", check->mode);
  encode_pair(out, "mode waits", waits ? "true" : "false");
}

static void encode_check(
  encode_t * out, const rcl_diagnosis_check_t * check, const rcl_diagnosis_measure_t * measure)
{
  if (measure->is_set) {
    encode_value(out, check->key, measure->value);
  } else {
    encode_pair(out, check->key, "unknown");
  }
  if (check->unit != NULL) {
    encode_pair(out, "unit", check->unit);
  }
  if (check->has_warn) {
    encode_value(out, "warn", check->warn);
  }
  if (check->has_error) {
    encode_value(out, "error", check->error);
  }
  if (check->mode != NULL) {
    encode_mode(out, check, measure->is_requested);
  }
}

static void encode_message(
  encode_t * out, const char * reason, const rcl_diagnosis_check_t * check, uint8_t level)
{
  const uint32_t begin = encode_text_begin(out);

  encode_words(out, reason);
  if (check != NULL) {
    encode_words(out, check->is_above ? " above " : " below ");
    encode_signed(out, rcl_diagnosis_limit(check, level));
  }
  encode_text_end(out, begin);
}

/* Level and message: those of the check count more than counters that have changed. */
static void encode_head(
  encode_t * out, const rcl_diagnosis_status_t * status, const rcl_diagnosis_measure_t * measure,
  const rcl_diagnosis_row_t * changed)
{
  const bool is_fault =
    measure->level == (uint8_t)DIAGNOSIS_WARN || measure->level == (uint8_t)DIAGNOSIS_ERROR;
  const bool is_changed = measure->level == (uint8_t)DIAGNOSIS_OK && changed != NULL;
  const uint8_t level = is_changed ? (uint8_t)DIAGNOSIS_WARN : measure->level;

  out->body[out->position] = level;
  ++out->position;
  encode_text(out, status->name);
  if (is_fault) {
    const rcl_diagnosis_check_t * check = &rcl_diagnosis_checks[status->check];

    encode_message(out, check->key, check, level);
  } else if (is_changed) {
    const uint32_t begin = encode_text_begin(out);

    encode_words(out, changed->key);
    encode_words(out, " has changed");
    encode_text_end(out, begin);
  } else {
    encode_text(out, level == (uint8_t)DIAGNOSIS_STALE ? "not set, or too long ago" : "ok");
  }
  encode_text(out, MICROROS_DIAGNOSIS_HARDWARE_ID);
}

uint32_t rcl_diagnosis_encode(const xrce_client_t * client, uint8_t status, uint8_t * body)
{
  static const rcl_diagnosis_measure_t nothing;
  const rcl_diagnosis_status_t * about = &rcl_diagnosis_statuses[status];
  const bool has_check = about->check != (uint8_t)DIAGNOSIS_NONE;
  const rcl_diagnosis_measure_t * measure = has_check ? rcl_diagnosis_measured(about->check) : &nothing;
  encode_t out = {body, 0, 0};
  uint32_t count_at;

  encode_stamp(&out);
  encode_text(&out, "");  /* frame_id */
  encode_number(&out, 1); /* statuses */
  encode_head(&out, about, measure, rcl_diagnosis_changed(client, status));
  encode_number(&out, 0);
  count_at = out.position - 4u;
  for (uint8_t i = 0; i < about->row_count; ++i) {
    const uint8_t row = (uint8_t)(about->first_row + i);

    encode_row(&out, &rcl_diagnosis_rows[row], rcl_diagnosis_count(client, row));
  }
  if (has_check) {
    encode_check(&out, &rcl_diagnosis_checks[about->check], measure);
  }
  cdr_put_4(&body[count_at], &out.values);
  return out.position;
}
