/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Events of all nodes arrive on one subscription of each local node. An event is read up to the node's name; if a
 * client watches that node, it keeps the rest.
 */
#include "microros/error.h"
#include "microros/lock.h"
#include "microros/rclc_parameter_client.h"
#include "microros/rclc_parameter_in.h"
#include "microros/rmw_node.h"
#include "microros/rmw_parameter_client.h"
#include "microros/rmw_subscription.h"
#include "microros/text.h"
#include "rcl_interfaces/msg/parameter_event.h"
#include "rmw/qos_profiles.h"

#include <stddef.h>

/* First bytes of an event that is too large: the time, the length of the node's name and its first characters. No
 * complete event has this size. */
enum { WATCH_STAMP = 8, WATCH_NAME_AT = 12, WATCH_BEGINNING = 27 };

/* The subscriptions, by node; NULL: none. */
static rmw_subscription_t * watch_subscriptions[MICROROS_NODES_MAX];

/* An event that is taken, for the clients of a node. */
typedef struct watch_event_t {
  const rcl_node_t * node;
  rclc_parameter_client_t * client; /* that watches the event's node; NULL: no client does */
  bool missed;
} watch_event_t;

/* Compares the first bytes of two names. */
static bool watch_is_alike(const char * name, const char * other, uint32_t size)
{
  uint32_t i = 0;

  while (i < size && name[i] == other[i]) {
    ++i;
  }
  return i == size;
}

/* Returns the client that watches the node with this name, without a NUL, or with these first bytes of a name. */
static rclc_parameter_client_t * watch_find(
  const rcl_node_t * node, const parameter_text_t * name, uint32_t known)
{
  rclc_parameter_client_t * client = rclc_parameter_client_first();

  while (client != NULL && (client->node != node || client->event_callback == NULL ||
                            microros_text_size(client->remote->name) != name->size ||
                            !watch_is_alike(client->remote->name, name->data, known))) {
    client = client->next;
  }
  return client;
}

/* Reads the beginning of an event that was too large. */
static void watch_decode_beginning(cdr_in_t * in, watch_event_t * event)
{
  const uint32_t known = (uint32_t)WATCH_BEGINNING - (uint32_t)WATCH_NAME_AT;
  uint32_t length;
  parameter_text_t name;

  in->position = WATCH_STAMP;
  cdr_get_4(in, &length, 1u, "node");
  name.data = (const char *)&in->body[WATCH_NAME_AT];
  name.size = length - 1u; /* the NUL */
  event->client = watch_find(event->node, &name, name.size < known ? name.size : known);
  event->missed = true;
  in->position = in->size;
}

static void watch_settle_list(rclc_parameter_client_t * client, cdr_in_t * in)
{
  const uint32_t count = rclc_parameter_in_length(in);

  for (uint32_t i = 0; i < count && !in->failed; ++i) {
    (void)rclc_parameter_client_read_text(in);
    rclc_parameter_client_settle_value(client, in);
  }
}

static void watch_decode(cdr_in_t * in, void * message)
{
  watch_event_t * event = message;
  parameter_text_t name;
  cdr_in_t kept;

  if (in->size == (uint32_t)WATCH_BEGINNING) {
    watch_decode_beginning(in, event);
    return;
  }
  (void)rclc_parameter_in_take(in, WATCH_STAMP, 1u);
  name = rclc_parameter_in_text(in);
  event->client = in->failed ? NULL : watch_find(event->node, &name, name.size);
  if (event->client == NULL) {
    in->position = in->size;
    return;
  }
  kept = rclc_parameter_client_keep(event->client, in);
  for (uint32_t i = 0; i < 3u; ++i) {
    watch_settle_list(event->client, &kept);
  }
  event->missed = kept.failed;
}

bool rclc_parameter_client_may_watch(const rclc_parameter_client_t * client, const rclc_executor_t * executor)
{
  const rclc_parameter_client_t * other;

  if (client->event_callback == NULL) {
    return true;
  }
  microros_lock();
  other = rclc_parameter_client_first();
  while (other != NULL && (other == client || other->node != client->node || other->event_callback == NULL ||
                           other->executor == NULL || executor == NULL || other->executor == executor)) {
    other = other->next;
  }
  microros_unlock();
  if (other != NULL) {
    (void)rclc_parameter_client_refuse(
      client, RCL_RET_ERROR,
      MICROROS_ERROR_WORDS("another executor runs a client of this node that watches"));
  }
  return other == NULL;
}

static const microros_message_type_t watch_message = {
  .dds_type_name = MICROROS_FLASH_NAME("rcl_interfaces::msg::dds_::ParameterEvent_"),
  .max_encoded_size = rcl_interfaces__msg__ParameterEvent__MAX_ENCODED_SIZE,
  .decode = watch_decode};

rcl_ret_t rclc_parameter_client_watch(
  rclc_parameter_client_t * client, rclc_parameter_client_event_callback_t callback, void * context)
{
  static const rosidl_message_type_support_t type = {
    .typesupport_identifier = MICROROS_TYPE_SUPPORT_IDENTIFIER, .data = &watch_message};
  const rclc_parameter_client_event_callback_t before = client != NULL ? client->event_callback : NULL;
  rmw_subscription_t ** subscription;
  rcl_ret_t result = RCL_RET_OK;

  if (client == NULL || !rcl_node_is_valid(client->node)) {
    return microros_error_refuse(RCL_RET_INVALID_ARGUMENT, "client");
  }
  subscription = &watch_subscriptions[rmw_node_index(client->node->impl)];
  if (callback != NULL && !rmw_subscription_is_open(*subscription)) {
    result = rmw_subscription_open(
      client->node->impl, &type, "/parameter_events", &rmw_qos_profile_parameter_events, subscription);
    if (result == RCL_RET_OK) {
      rmw_parameter_client_keep_beginning(*subscription, (uint8_t)WATCH_BEGINNING);
    }
  }
  if (result == RCL_RET_OK) {
    client->event_callback = callback;
    client->event_context = context;
    if (!rclc_parameter_client_may_watch(client, client->executor)) {
      client->event_callback = before;
      result = RCL_RET_ERROR;
    }
  }
  return result;
}

void rclc_parameter_client_unwatch(rclc_parameter_client_t * client)
{
  rmw_subscription_t ** subscription = &watch_subscriptions[rmw_node_index(client->node->impl)];
  const rclc_parameter_client_t * other;

  client->event_callback = NULL;
  microros_lock();
  other = rclc_parameter_client_first();
  while (other != NULL && (other->node != client->node || other->event_callback == NULL)) {
    other = other->next;
  }
  microros_unlock();
  if (other == NULL && rmw_subscription_is_open(*subscription)) {
    rmw_parameter_client_keep_beginning(*subscription, 0u);
    rmw_subscription_close(*subscription);
  }
}

bool rclc_parameter_client_has_event(const rclc_parameter_client_t * client)
{
  const rmw_subscription_t * subscription = watch_subscriptions[rmw_node_index(client->node->impl)];

  return client->event_callback != NULL && rmw_subscription_is_open(subscription) &&
         rmw_subscription_is_ready(subscription);
}

static void watch_notify_list(
  rclc_parameter_client_t * client, cdr_in_t * in, rclc_parameter_client_change_t change)
{
  const uint32_t count = rclc_parameter_in_length(in);

  for (uint32_t i = 0; i < count && client->event_callback != NULL; ++i) {
    const char * name = rclc_parameter_client_read_text(in);
    rclc_parameter_client_value_t value;

    rclc_parameter_client_read_value(client, in, &value);
    client->event_callback(client, change, name, &value, client->event_context);
  }
}

static void watch_notify(const watch_event_t * event)
{
  rclc_parameter_client_t * client = event->client;
  cdr_fault_t fault;
  cdr_in_t in = rclc_parameter_client_begin(client, &fault);

  client->in_event = true;
  if (event->missed) { /* it is watched: the event was kept for it */
    client->event_callback(client, RCLC_PARAMETER_CLIENT_MISSED, "", NULL, client->event_context);
  } else {
    watch_notify_list(client, &in, RCLC_PARAMETER_CLIENT_NEW);
    watch_notify_list(client, &in, RCLC_PARAMETER_CLIENT_CHANGED);
    watch_notify_list(client, &in, RCLC_PARAMETER_CLIENT_DELETED);
  }
  client->in_event = false;
}

void rclc_parameter_client_take_event(const rclc_parameter_client_t * client)
{
  watch_event_t event = {client->node, NULL, false};
  bool taken = false;

  /* The subscription has counted a refused event; the node of a damaged event is unknown. */
  (void)rmw_subscription_take(watch_subscriptions[rmw_node_index(client->node->impl)], &event, &taken);
  if (taken && event.client != NULL) {
    if (!event.client->is_busy) {
      event.client->call = (uint8_t)RCLC_PARAMETER_CLIENT_CALLS; /* its last result is overwritten */
    }
    watch_notify(&event);
    event.client->size = 0;
  }
}
