/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_value.h"

#include "microros/cdr.h"
#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_string.h"

#include <stddef.h>
#include <string.h>

/* Bytes of the integer and the double of a value. */
enum { VALUE_NUMBERS = 16 };

static const rclc_parameter_about_t value_about_nothing = {.name = ""};

const rclc_parameter_place_t rclc_parameter_nothing = {.about = &value_about_nothing};

#if MICROROS_PARAMETER_STRING_SIZE > 0u || MICROROS_PARAMETER_ARRAY_SIZE > 0u
enum { VALUE_REST = 0 };

static void value_out_rest(parameter_out_t * out, const rclc_parameter_place_t * place, const uint8_t * to)
{
  (void)to;
  rclc_parameter_out_text(out, rclc_parameter_string_of(place));
  rclc_parameter_out_arrays(out, place);
}
#else
/* An empty string and five empty arrays: a length of 1, a NUL with its padding, five lengths of 0. */
enum { VALUE_REST = 4 + 4 + PARAMETER_ARRAYS * 4 };

static void value_out_rest(const parameter_out_t * out, const rclc_parameter_place_t * place, uint8_t * to)
{
  (void)out;
  (void)place;
  if (to != NULL) {
    to[VALUE_NUMBERS] = 1;
  }
}
#endif

/* All of it is cleared at once, since all but one member is zero and a call of memset costs more than its bytes. */
void rclc_parameter_out_value(parameter_out_t * out, const rclc_parameter_place_t * place)
{
  const uint8_t type = place->type;
  const uint32_t numbers = cdr_aligned(out->position + 2u, 8u) - out->position;
  const uint32_t size = numbers + (uint32_t)VALUE_NUMBERS + (uint32_t)VALUE_REST;
  uint8_t * to = rclc_parameter_out_take(out, 1u, size);

  if (to != NULL) {
    (void)memset(to, 0, (size_t)size);
    to[0] = type;
    to[1] = type == (uint8_t)RCLC_PARAMETER_BOOL && place->value.bool_value ? 1u : 0u;
    to = &to[numbers];
    if (type == (uint8_t)RCLC_PARAMETER_INT) {
      cdr_put_8(&to[0], &place->value);
    } else if (type == (uint8_t)RCLC_PARAMETER_DOUBLE) {
      cdr_put_8(&to[8], &place->value);
    } else {
      /* all other members are set */
    }
  }
  value_out_rest(out, place, to);
}
