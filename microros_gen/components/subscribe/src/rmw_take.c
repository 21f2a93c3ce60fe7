/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/epoch.h"
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/port.h"
#include "microros/rmw_client.h"
#include "microros/rmw_decode.h"
#include "microros/rmw_local_take.h"
#include "microros/rmw_receiver.h"
#include "microros/rmw_subscription.h"
#include "microros/xrce_read.h"
#include "rmw/rmw.h"

#include <string.h>

/* Bytes 00 01 00 00 or 00 00 00 00: XCDR1 in either byte order, no options (OMG DDS-XTypes 1.3, 7.6.3.1.2). */
enum { TAKE_ENCAPSULATION_SIZE = 4, TAKE_LITTLE_ENDIAN = 1 };

/* XRCE carries neither the sender of a sample nor its time; only the time of arrival is known. */
void rmw_subscription_describe(const rmw_subscription_t * subscription, rmw_message_info_t * info)
{
  const int64_t ns_per_ms = 1000000;
  xrce_sample_t sample;
  int64_t age_ns;
  int64_t epoch_ns;

  (void)memset(info, 0, sizeof(*info));
  if (rmw_local_describe(subscription->data, info) || !xrce_read_peek(subscription->data, &sample)) {
    return;
  }
  age_ns = (int64_t)(port_time_ms() - sample.arrived_ms) * ns_per_ms;
  epoch_ns = microros_epoch_known_ns();
  info->received_timestamp = epoch_ns != 0 ? epoch_ns - age_ns : 0; /* the time of day has not been set yet */
  info->publication_sequence_number = RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED;
  info->reception_sequence_number = RMW_MESSAGE_INFO_SEQUENCE_NUMBER_UNSUPPORTED;
  info->publisher_gid.implementation_identifier = rmw_implementation_identifier;
}

static rmw_ret_t take_message(const rmw_subscription_t * subscription, void * ros_message, bool * taken)
{
  const xrce_endpoint_t * endpoint = subscription->data;
  xrce_sample_t sample;
  rmw_ret_t result;

  *taken = false;
  if (rmw_local_take(endpoint, ros_message, &result)) {
    *taken = result == RMW_RET_OK;
    return result;
  }
  if (rmw_receiver_report(endpoint)) {
    return RMW_RET_ERROR;
  }
  if (!xrce_read_peek(endpoint, &sample)) {
    return RMW_RET_OK;
  }
  result = rmw_decode(endpoint->type, sample.data, sample.size, sample.big_endian, ros_message);
  xrce_read_pop(endpoint, result != RMW_RET_OK);
  *taken = result == RMW_RET_OK;
  return result;
}

static rmw_ret_t take_serialized(
  const rmw_subscription_t * subscription, rmw_serialized_message_t * serialized_message, bool * taken)
{
  const xrce_endpoint_t * endpoint = subscription->data;
  xrce_sample_t sample;
  rmw_ret_t result;
  size_t size;

  *taken = false;
  if (rmw_local_take_serialized(endpoint, serialized_message, &result)) {
    *taken = result == RMW_RET_OK;
    return result;
  }
  if (rmw_receiver_report(endpoint)) {
    return RMW_RET_ERROR;
  }
  if (!xrce_read_peek(endpoint, &sample)) {
    return RMW_RET_OK;
  }
  size = TAKE_ENCAPSULATION_SIZE + (size_t)sample.size;
  if (
    serialized_message->buffer_capacity < size &&
    rmw_serialized_message_resize(serialized_message, size) != RCUTILS_RET_OK) {
    return RMW_RET_BAD_ALLOC;
  }
  (void)memset(serialized_message->buffer, 0, TAKE_ENCAPSULATION_SIZE);
  serialized_message->buffer[1] = sample.big_endian ? (uint8_t)0 : (uint8_t)TAKE_LITTLE_ENDIAN;
  (void)memcpy(&serialized_message->buffer[TAKE_ENCAPSULATION_SIZE], sample.data, sample.size);
  serialized_message->buffer_length = size;
  xrce_read_pop(endpoint, false);
  *taken = true;
  return RMW_RET_OK;
}

rmw_ret_t rmw_subscription_take(const rmw_subscription_t * subscription, void * ros_message, bool * taken)
{
  rmw_ret_t result;

  microros_lock();
  result = take_message(subscription, ros_message, taken);
  microros_unlock();
  return result;
}

rmw_ret_t rmw_subscription_take_serialized(
  const rmw_subscription_t * subscription, rmw_serialized_message_t * serialized_message, bool * taken)
{
  rmw_ret_t result;

  microros_lock();
  result = take_serialized(subscription, serialized_message, taken);
  microros_unlock();
  return result;
}

rmw_ret_t rmw_take_with_info(
  const rmw_subscription_t * subscription, void * ros_message, bool * taken,
  rmw_message_info_t * message_info, rmw_subscription_allocation_t * allocation)
{
  rmw_ret_t result;

  (void)allocation;
  if (
    !rmw_subscription_is_open(subscription) || ros_message == NULL || taken == NULL || message_info == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "subscription, message, taken or message_info");
  }
  microros_lock();
  rmw_subscription_pump(subscription);
  rmw_subscription_describe(subscription, message_info);
  result = rmw_subscription_take(subscription, ros_message, taken);
  microros_unlock();
  return result;
}

rmw_ret_t rmw_take(
  const rmw_subscription_t * subscription, void * ros_message, bool * taken,
  rmw_subscription_allocation_t * allocation)
{
  rmw_message_info_t info;

  return rmw_take_with_info(subscription, ros_message, taken, &info, allocation);
}

rmw_ret_t rmw_take_serialized_message(
  const rmw_subscription_t * subscription, rmw_serialized_message_t * serialized_message, bool * taken,
  rmw_subscription_allocation_t * allocation)
{
  (void)allocation;
  if (!rmw_subscription_is_open(subscription) || serialized_message == NULL || taken == NULL) {
    return microros_error_refuse(RMW_RET_INVALID_ARGUMENT, "subscription, serialized_message or taken");
  }
  rmw_subscription_pump(subscription);
  return rmw_subscription_take_serialized(subscription, serialized_message, taken);
}
