/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/rclc_parameter_value.h"

#include "microros/rclc_parameter_array.h"
#include "microros/rclc_parameter_string.h"

void rclc_parameter_out_value(parameter_out_t * out, const rclc_parameter_place_t * place)
{
  const uint8_t type = place != NULL ? place->type : (uint8_t)RCLC_PARAMETER_NOT_SET;
  const int64_t integer = type == (uint8_t)RCLC_PARAMETER_INT ? place->value.integer_value : 0;
  const double number = type == (uint8_t)RCLC_PARAMETER_DOUBLE ? place->value.double_value : 0.0;
  const bool truth = type == (uint8_t)RCLC_PARAMETER_BOOL && place->value.bool_value;

  rclc_parameter_out_1(out, type);
  rclc_parameter_out_1(out, truth ? 1u : 0u);
  rclc_parameter_out_8(out, &integer);
  rclc_parameter_out_8(out, &number);
  rclc_parameter_out_text(out, rclc_parameter_string_of(place));
  rclc_parameter_out_arrays(out, place);
}
