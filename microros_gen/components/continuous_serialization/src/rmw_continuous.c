/* SPDX-License-Identifier: Apache-2.0 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rmw_encode.h"
#include "microros/rmw_local_publish.h"
#include "microros/rmw_peer_publish.h"
#include "microros/rmw_publish_parts.h"
#include "microros/rmw_publisher.h"
#include "microros/xrce_client.h"
#include "microros/xrce_drops.h"
#include "microros/xrce_gate.h"
#include "microros/xrce_written.h"
#include "rmw_microros/continous_serialization.h"

#include <stddef.h>

/* A message while it is written. */
typedef struct continuous_message_t {
  const xrce_endpoint_t * writer;
  uint32_t size;  /* of the whole body */
  uint32_t start; /* bytes before those of the callback */
  uint32_t done;  /* bytes of the body in fragments that the agent has */
  xrce_continuous_outcome_t outcome;
} continuous_message_t;

void rmw_uros_set_continous_serialization_callbacks(
  rmw_publisher_t * publisher, rmw_uros_continous_serialization_size size_cb,
  rmw_uros_continous_serialization serialization_cb)
{
  const xrce_continuous_callbacks_t callbacks = {size_cb, serialization_cb};
  const xrce_endpoint_t * writer;

  if (!rmw_publisher_is_open(publisher)) {
    return;
  }
  writer = publisher->data;
  microros_lock();
  writer->client->continuous_callbacks[writer->index] = callbacks;
  microros_unlock();
}

void rmw_publish_parts_clear(const xrce_endpoint_t * writer)
{
  const xrce_continuous_callbacks_t none = {NULL, NULL};

  writer->client->continuous_callbacks[writer->index] = none;
}

/* Bytes of the message's body before `position`, which is in the buffer. */
static uint32_t continuous_body(const continuous_message_t * message, const ucdrBuffer * ucdr)
{
  return message->done + (uint32_t)ucdr_buffer_length(ucdr);
}

/* The application may have moved the iterator. */
static bool continuous_is_inside(const ucdrBuffer * ucdr)
{
  return ucdr->iterator >= ucdr->init && ucdr->iterator <= ucdr->final;
}

/* Gives the buffer the room of the next fragment, or what is left of the message. */
static void continuous_open(
  const continuous_message_t * message, ucdrBuffer * ucdr, uint8_t * at, size_t room)
{
  const size_t left = (size_t)message->size - (size_t)message->done;

  ucdr->init = at;
  ucdr->iterator = at;
  ucdr->final = &at[left < room ? left : room];
  ucdr->origin = (size_t)message->done;
}

/* Sends what is in the buffer. The header of WRITE_DATA precedes it in the first fragment. */
static bool continuous_send(continuous_message_t * message, const ucdrBuffer * ucdr, bool is_last)
{
  const uint8_t * first = &message->writer->client->continuous.message[XRCE_CONTINUOUS_FRONT];

  microros_lock();
  message->outcome = xrce_continuous_send(message->writer, (size_t)(ucdr->iterator - first), is_last);
  microros_unlock();
  return message->outcome == XRCE_CONTINUOUS_DONE;
}

/* Called by functions of ucdr. Returns true for an error: the message is whole, or the agent does not get it. */
static bool continuous_on_full(ucdrBuffer * ucdr, void * args)
{
  continuous_message_t * message = args;

  if (
    !continuous_is_inside(ucdr) || continuous_body(message, ucdr) == message->size ||
    !continuous_send(message, ucdr, false)) {
    return true;
  }
  message->done = continuous_body(message, ucdr);
  continuous_open(
    message, ucdr, &message->writer->client->continuous.message[XRCE_CONTINUOUS_FRONT], XRCE_CONTINUOUS_ROOM);
  return false;
}

/* Counts a message that was not published. */
static rmw_ret_t continuous_refuse(
  const xrce_endpoint_t * writer, microros_error_t error, uint32_t found, uint32_t fits)
{
  microros_error_set(error, writer->name, NULL, found, fits);
  microros_lock();
  xrce_drops_add(writer->client, writer->index);
  microros_unlock();
  return RMW_RET_ERROR;
}

/* Encodes the message, lets the application write the rest, and sends the last fragment. */
static rmw_ret_t continuous_write(
  continuous_message_t * message, const void * ros_message, const xrce_continuous_callbacks_t * callbacks)
{
  const xrce_endpoint_t * writer = message->writer;
  uint8_t * head = &writer->client->continuous.message[XRCE_CONTINUOUS_FRONT];
  uint8_t * body = &head[XRCE_WRITE_PREFIX];
  cdr_fault_t fault; /* set if the message is refused */
  uint32_t found;
  ucdrBuffer ucdr;

  ucdr_init_buffer_origin_offset_endian(&ucdr, body, 0u, 0u, 0u, UCDR_LITTLE_ENDIANNESS);
  ucdr_set_on_full_buffer_callback(&ucdr, continuous_on_full, message);
  continuous_open(message, &ucdr, body, XRCE_CONTINUOUS_ROOM - XRCE_WRITE_PREFIX);
  xrce_put_submessage(
    head, XRCE_WRITE_DATA, XRCE_FLAG_LITTLE_ENDIAN, (uint16_t)(XRCE_OBJECT_PREFIX + message->size));
  xrce_put_be16(&head[4], XRCE_REQUEST_NONE);
  xrce_put_be16(&head[6], xrce_object_id(writer->index, XRCE_KIND_DATAWRITER));
  found = writer->type->encoded_size(ros_message, &fault);
  if (found != message->start) { /* a callback or another task has changed it */
    return continuous_refuse(writer, microros_error_continuous_written, found, message->start);
  }
  found = writer->type->encode(ros_message, body, &fault);
  if (found == 0u) {
    return rmw_encode_refuse(writer->type, &fault);
  }
  ucdr_advance_buffer(&ucdr, (size_t)found);
  if (callbacks->serialize != NULL) {
    callbacks->serialize(&ucdr);
  }
  found = continuous_is_inside(&ucdr) ? continuous_body(message, &ucdr) : 0u;
  if (message->outcome == XRCE_CONTINUOUS_DONE) {
    if (ucdr.error || found != message->size) {
      return continuous_refuse(writer, microros_error_continuous_written, found, message->size);
    }
    if (continuous_send(message, &ucdr, true)) {
      return RMW_RET_OK;
    }
  }
  return continuous_refuse(writer, microros_error_continuous_lost, message->done, message->size);
}

static rmw_ret_t continuous_begin(const xrce_endpoint_t * writer)
{
  xrce_continuous_outcome_t outcome;

  microros_lock();
  outcome = xrce_continuous_begin(writer);
  microros_unlock();
  if (outcome == XRCE_CONTINUOUS_LOST) {
    return continuous_refuse(writer, microros_error_no_session, 0, 0);
  }
  if (outcome == XRCE_CONTINUOUS_TIMEOUT) {
    return continuous_refuse(writer, microros_error_continuous_busy, XRCE_CONTINUOUS_TIMEOUT_MS, 0);
  }
  return RMW_RET_OK;
}

/* Returns the error that prevents a message, which has `size` bytes before the callback adds its own to *whole. */
static rmw_ret_t continuous_check(const xrce_endpoint_t * writer, uint32_t size, uint32_t whole)
{
  if (rmw_local_has_route(writer) || rmw_peer_has_route(writer)) {
    return continuous_refuse(writer, microros_error_continuous_local, 0, 0);
  }
  if ((writer->qos & XRCE_QOS_RELIABLE) == 0u) {
    return continuous_refuse(writer, microros_error_continuous_reliability, 0, 0);
  }
  if (whole > (uint32_t)XRCE_CONTINUOUS_LARGEST) {
    return continuous_refuse(writer, microros_error_continuous_size, whole, XRCE_CONTINUOUS_LARGEST);
  }
  if (size > (uint32_t)XRCE_CONTINUOUS_ROOM - XRCE_WRITE_PREFIX) {
    return continuous_refuse(
      writer, microros_error_continuous_start, size, XRCE_CONTINUOUS_ROOM - XRCE_WRITE_PREFIX);
  }
  if (whole < size) {
    return continuous_refuse(writer, microros_error_continuous_written, size, whole);
  }
  return RMW_RET_OK;
}

static rmw_ret_t continuous_publish(
  const xrce_endpoint_t * writer, const void * ros_message, const xrce_continuous_callbacks_t * callbacks)
{
  continuous_message_t message = {.writer = writer, .outcome = XRCE_CONTINUOUS_DONE};
  cdr_fault_t fault; /* set if the message is refused */
  const uint32_t size = writer->type->encoded_size(ros_message, &fault);
  rmw_ret_t result;

  if (size == 0u) {
    return rmw_encode_refuse(writer->type, &fault);
  }
  message.size = size;
  message.start = size;
  if (callbacks->size != NULL) {
    callbacks->size(&message.size);
  }
  result = continuous_check(writer, size, message.size);
  if (result == RMW_RET_OK) {
    result = continuous_begin(writer);
  }
  if (result != RMW_RET_OK) {
    return result;
  }
  result = continuous_write(&message, ros_message, callbacks);
  microros_lock();
  xrce_continuous_end(writer->client, result == RMW_RET_OK);
  if (result == RMW_RET_OK) {
    xrce_written(writer);
  }
  microros_unlock();
  return result;
}

bool rmw_publish_parts(const xrce_endpoint_t * writer, const void * ros_message, rmw_ret_t * result)
{
  xrce_continuous_callbacks_t callbacks;
  bool is_open;

  microros_lock();
  callbacks = writer->client->continuous_callbacks[writer->index];
  is_open = xrce_gate_is_open(writer); /* otherwise the message is dropped as any other */
  microros_unlock();
  if (!is_open || (callbacks.size == NULL && callbacks.serialize == NULL)) {
    return false;
  }
  *result = continuous_publish(writer, ros_message, &callbacks);
  return true;
}
