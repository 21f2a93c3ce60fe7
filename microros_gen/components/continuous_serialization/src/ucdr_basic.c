/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/ucdr_put.h"

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
