/* SPDX-License-Identifier: Apache-2.0 */
/* Values, arrays and sequences of them. */
#include "microros/ucdr_put.h"

#include <string.h>

bool ucdr_serialize_char(ucdrBuffer * ub, char value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_bool(ucdrBuffer * ub, bool value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_uint8_t(ucdrBuffer * ub, uint8_t value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_uint16_t(ucdrBuffer * ub, uint16_t value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_uint32_t(ucdrBuffer * ub, uint32_t value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_uint64_t(ucdrBuffer * ub, uint64_t value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_int8_t(ucdrBuffer * ub, int8_t value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_int16_t(ucdrBuffer * ub, int16_t value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_int32_t(ucdrBuffer * ub, int32_t value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_int64_t(ucdrBuffer * ub, int64_t value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_float(ucdrBuffer * ub, float value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_double(ucdrBuffer * ub, double value)
{
  return ucdr_put(ub, &value, sizeof(value), 1u);
}

bool ucdr_serialize_array_char(ucdrBuffer * ub, const char * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_bool(ucdrBuffer * ub, const bool * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_uint8_t(ucdrBuffer * ub, const uint8_t * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_uint16_t(ucdrBuffer * ub, const uint16_t * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_uint32_t(ucdrBuffer * ub, const uint32_t * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_uint64_t(ucdrBuffer * ub, const uint64_t * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_int8_t(ucdrBuffer * ub, const int8_t * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_int16_t(ucdrBuffer * ub, const int16_t * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_int32_t(ucdrBuffer * ub, const int32_t * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_int64_t(ucdrBuffer * ub, const int64_t * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_float(ucdrBuffer * ub, const float * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_array_double(ucdrBuffer * ub, const double * array, size_t size)
{
  return ucdr_put(ub, array, sizeof(*array), size);
}

bool ucdr_serialize_sequence_char(ucdrBuffer * ub, const char * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_bool(ucdrBuffer * ub, const bool * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_uint8_t(ucdrBuffer * ub, const uint8_t * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_uint16_t(ucdrBuffer * ub, const uint16_t * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_uint32_t(ucdrBuffer * ub, const uint32_t * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_uint64_t(ucdrBuffer * ub, const uint64_t * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_int8_t(ucdrBuffer * ub, const int8_t * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_int16_t(ucdrBuffer * ub, const int16_t * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_int32_t(ucdrBuffer * ub, const int32_t * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_int64_t(ucdrBuffer * ub, const int64_t * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_float(ucdrBuffer * ub, const float * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_sequence_double(ucdrBuffer * ub, const double * array, uint32_t size)
{
  return ucdr_serialize_uint32_t(ub, size) && ucdr_put(ub, array, sizeof(*array), (size_t)size);
}

bool ucdr_serialize_string(ucdrBuffer * ub, const char * string)
{
  const size_t size = strlen(string) + 1u; /* with its NUL */

  return size <= UINT32_MAX && ucdr_serialize_sequence_char(ub, string, (uint32_t)size);
}
