/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/ucdr_put.h"

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
