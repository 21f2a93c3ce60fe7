/* SPDX-License-Identifier: Apache-2.0 */
/* Calls on what is initialized, finalized, or shut down: compiled against ROS 2's librcl and against the generated library,
 * which has an agent that grants everything (tests/runtime/c/port_agent.c). */
#include "tell.h"

#include <rcl/guard_condition.h>
#include <rcl/rcl.h>
#include <rcl/timer.h>
#include <rcl/wait.h>
#include <std_msgs/msg/int32.h>
#include <std_srvs/srv/set_bool.h>
#include <string.h>

static rcl_context_t context;
static rcl_node_t node;
static rcl_clock_t clock_;
static rcl_allocator_t allocator;

static void tell_qos(const char * what, const rmw_qos_profile_t * qos)
{
  SAY("QoS of %s 0\n", what);
  TELL(qos->reliability);
  TELL(qos->durability);
  TELL(qos->history);
  TELL(qos->depth);
  TELL(qos->liveliness);
  TELL(qos->deadline.sec);
  TELL(qos->lifespan.nsec);
  TELL(qos->liveliness_lease_duration.sec);
  TELL(qos->avoid_ros_namespace_conventions);
}

static void start(void)
{
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  rcl_node_options_t choices = rcl_node_get_default_options();
  rcl_node_t another = rcl_get_zero_initialized_node();
  size_t domain = 7;

  context = rcl_get_zero_initialized_context();
  node = rcl_get_zero_initialized_node();
  TELL(rcl_init_options_init(&options, heap));
  TELL(rcl_init(0, NULL, &options, &context));
  TELL(rcl_init(0, NULL, &options, &context));
  TELL(rcl_context_is_valid(&context));
  TELL(rcl_context_get_instance_id(&context) != 0u);
  TELL(rcl_context_get_domain_id(&context, &domain));
  TELL(domain);
  TELL(rcl_context_get_domain_id(&context, NULL));
  TELL(rcl_context_get_rmw_context(&context) != NULL);
  TELL(rcl_context_fini(&context));
  TELL(rcl_init_options_fini(&options));
  TELL(rcl_context_is_valid(&context));
  TELL(rcl_node_init(&node, "a b", "", &context, &choices));
  TELL(rcl_node_init(&node, "a", "b c", &context, &choices));
  TELL(rcl_node_init(&node, "", "", &context, &choices));
  TELL(rcl_node_init(&node, "n", "/s", &context, &choices));
  TELL(rcl_node_init(&node, "n", "/s", &context, &choices));
  TELL(rcl_node_is_valid(&node));
  TELL(strcmp(rcl_node_get_name(&node), "n"));
  TELL(strcmp(rcl_node_get_namespace(&node), "/s"));
  TELL(strcmp(rcl_node_get_logger_name(&node), "s.n"));
  TELL(rcl_node_get_domain_id(&node, &domain));
  TELL(rcl_node_get_domain_id(&node, NULL));
  TELL(rcl_node_init(&another, "m", "", &context, &choices));
  TELL(strcmp(rcl_node_get_namespace(&another), "/"));
  TELL(strcmp(rcl_node_get_logger_name(&another), "m"));
  TELL(rcl_node_fini(&another));
  TELL(rcl_node_fini(&another));
  TELL(rcl_node_is_valid(&another));
  TELL(rcl_node_get_name(&another) != NULL);
  TELL(rcl_node_get_domain_id(&another, &domain));
  TELL(rcl_node_init(&another, "m", "", &context, &choices));
  TELL(rcl_node_fini(&another));
}

static void resolve(const char * name, bool is_service)
{
  char * full = NULL;

  SAY("'%s' %ld\n", name, (long)rcl_node_resolve_name(&node, name, heap, is_service, false, &full));
  SAY("'%s' 0\n", full != NULL ? full : "");
  free(full);
  rcl_reset_error();
}

static void names(void)
{
  const rcl_allocator_t none = rcutils_get_zero_initialized_allocator();
  rcl_node_t nothing = rcl_get_zero_initialized_node();
  char many[300];
  char * full = NULL;

  resolve("a", false);
  resolve("/a", true);
  resolve("~/a", false);
  resolve("~", true);
  resolve("{node}/a", false);
  resolve("a{ns}", false);
  resolve("{ns}/a", false);
  resolve("a//b", false);
  resolve("a//b", true);
  resolve("{x}", false);
  resolve("{x}", true);
  resolve("a b", false);
  resolve("a b", true);
  memset(many, 'a', sizeof(many));
  many[0] = '/';
  many[247] = '\0';
  resolve(many, false);
  many[247] = 'a';
  many[248] = '\0';
  resolve(many, false);
  resolve(many, true);
  TELL(rcl_node_resolve_name(&nothing, "a", heap, false, false, &full));
  TELL(rcl_node_resolve_name(&node, NULL, heap, false, false, &full));
  TELL(rcl_node_resolve_name(&node, "a", heap, false, false, NULL));
  TELL(rcl_node_resolve_name(&node, "a", none, false, false, &full));
  TELL(rcl_node_resolve_name(&node, "a", heap, false, true, &full));
  free(full);
}

static void many_names(rcl_publisher_t * publisher, rcl_subscription_t * subscription)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  const rosidl_service_type_support_t * service = ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool);
  rcl_publisher_options_t sends = rcl_publisher_get_default_options();
  rcl_subscription_options_t takes = rcl_subscription_get_default_options();
  rcl_client_options_t asks = rcl_client_get_default_options();
  rcl_service_options_t answers = rcl_service_get_default_options();
  rcl_client_t client = rcl_get_zero_initialized_client();
  rcl_service_t server = rcl_get_zero_initialized_service();
  rcl_node_options_t choices = rcl_node_get_default_options();
  rcl_node_t another = rcl_get_zero_initialized_node();
  char many[300];

  memset(many, 'a', sizeof(many));
  many[0] = '/';
  many[248] = '\0';
  TELL(rcl_publisher_init(publisher, &node, type, many, &sends));
  TELL(rcl_subscription_init(subscription, &node, type, many, &takes));
  TELL(rcl_client_init(&client, &node, service, many, &asks));
  TELL(rcl_service_init(&server, &node, service, many, &answers));
  TELL(rcl_publisher_init(publisher, &node, type, "a b", &sends));
  TELL(rcl_publisher_init(publisher, &node, type, "{x}", &sends));
  TELL(rcl_subscription_init(subscription, &node, type, "a//b", &takes));
  TELL(rcl_subscription_init(subscription, &node, type, "", &takes));
  TELL(rcl_client_init(&client, &node, service, "1", &asks));
  TELL(rcl_service_init(&server, &node, service, "{x}", &answers));
  TELL(rcl_node_init(&another, "m", many, &context, &choices));
  many[257] = '\0';
  many[248] = 'a';
  TELL(rcl_node_init(&another, &many[1], "", &context, &choices));
  TELL(rcl_publisher_init(publisher, &node, type, "{node}/{ns}", &sends));
  TELL(rcl_publisher_init(publisher, &node, type, "a{ns}/{node}", &sends));
  TELL(strcmp(rcl_publisher_get_topic_name(publisher), "/s/a/s/n"));
  TELL(rcl_publisher_fini(publisher, &node));
}

static void publishers(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  rcl_subscription_t subscription = rcl_get_zero_initialized_subscription();
  rcl_publisher_options_t sends = rcl_publisher_get_default_options();
  rcl_node_t nothing = rcl_get_zero_initialized_node();
  std_msgs__msg__Int32 message;

  memset(&message, 0, sizeof(message));
  many_names(&publisher, &subscription);
  TELL(rcl_publisher_get_actual_qos(&publisher) != NULL);
  TELL(rcl_publisher_get_options(&publisher) != NULL);
  TELL(rcl_publisher_get_options(NULL) != NULL);
  TELL(rcl_publisher_assert_liveliness(&publisher));
  TELL(rcl_publisher_init(&publisher, &node, type, "/a", &sends));
  TELL(rcl_publisher_init(&publisher, &node, type, "/a", &sends));
  TELL(rcl_publisher_is_valid(&publisher));
  TELL(rcl_publisher_is_valid_except_context(&publisher));
  TELL(rcl_publish(&publisher, &message, NULL));
  TELL(rcl_publish(&publisher, NULL, NULL));
  TELL(rcl_publisher_assert_liveliness(&publisher));
  TELL(rcl_publisher_assert_liveliness(NULL));
  TELL(rcl_publisher_wait_for_all_acked(&publisher, RCL_MS_TO_NS(100)));
  TELL(rcl_publisher_fini(&publisher, &nothing));
  TELL(rcl_publisher_is_valid(&publisher));
  tell_qos("a publisher", rcl_publisher_get_actual_qos(&publisher));
  TELL(rcl_publisher_get_options(&publisher)->qos.depth);
  TELL(rcl_publisher_get_options(&publisher)->disable_loaned_message);
  TELL(rcl_publisher_fini(&publisher, &node));
  TELL(rcl_publisher_fini(&publisher, &node));
  TELL(rcl_publisher_is_valid(&publisher));
  TELL(rcl_publish(&publisher, &message, NULL));
  TELL(rcl_publisher_get_topic_name(&publisher) != NULL);
  TELL(rcl_publisher_get_actual_qos(&publisher) != NULL);
  sends.qos = rmw_qos_profile_system_default;
  sends.qos.depth = 3;
  TELL(rcl_publisher_init(&publisher, &node, type, "/a", &sends));
  tell_qos("system defaults", rcl_publisher_get_actual_qos(&publisher));
  TELL(rcl_publisher_fini(&publisher, &node));
  sends.qos = rmw_qos_profile_sensor_data;
  sends.qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  TELL(rcl_publisher_init(&publisher, &node, type, "/a", &sends));
  tell_qos("another publisher", rcl_publisher_get_actual_qos(&publisher));
  TELL(rcl_publisher_get_options(&publisher)->qos.durability);
  TELL(rcl_publisher_fini(&publisher, &node));
}

static void subscriptions(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_subscription_t subscription = rcl_get_zero_initialized_subscription();
  rcl_subscription_options_t takes = rcl_subscription_get_default_options();
  rmw_message_info_t info;
  std_msgs__msg__Int32 message;

  memset(&message, 0, sizeof(message));
  TELL(rcl_subscription_get_actual_qos(&subscription) != NULL);
  TELL(rcl_subscription_get_options(&subscription) != NULL);
  TELL(rcl_subscription_init(&subscription, &node, type, "/b", &takes));
  TELL(rcl_subscription_init(&subscription, &node, type, "/b", &takes));
  TELL(rcl_subscription_is_valid(&subscription));
  TELL(rcl_take(&subscription, &message, &info, NULL));
  TELL(rcl_take(&subscription, &message, NULL, NULL));
  TELL(rcl_take(&subscription, NULL, NULL, NULL));
  TELL(rcl_take_serialized_message(&subscription, NULL, NULL, NULL));
  tell_qos("a subscription", rcl_subscription_get_actual_qos(&subscription));
  TELL(rcl_subscription_get_options(&subscription)->qos.reliability);
  TELL(rcl_subscription_fini(&subscription, &node));
  TELL(rcl_subscription_fini(&subscription, &node));
  TELL(rcl_subscription_is_valid(&subscription));
  TELL(rcl_take(&subscription, &message, NULL, NULL));
  TELL(rcl_subscription_get_options(&subscription) != NULL);
  TELL(rcl_subscription_init(&subscription, &node, type, "~/b", &takes));
  TELL(strcmp(rcl_subscription_get_topic_name(&subscription), "/s/n/b"));
  TELL(rcl_subscription_fini(&subscription, &node));
}

static void services(void)
{
  const rosidl_service_type_support_t * type = ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool);
  rcl_service_t service = rcl_get_zero_initialized_service();
  rcl_service_options_t choices = rcl_service_get_default_options();
  std_srvs__srv__SetBool_Request request;
  rmw_request_id_t id;

  memset(&request, 0, sizeof(request));
  memset(&id, 0, sizeof(id));
  TELL(rcl_service_get_options(&service) != NULL);
  TELL(rcl_service_request_subscription_get_actual_qos(&service) != NULL);
  TELL(rcl_service_init(&service, &node, type, "c", &choices));
  TELL(rcl_service_init(&service, &node, type, "c", &choices));
  TELL(rcl_service_is_valid(&service));
  TELL(rcl_take_request(&service, &id, &request));
  TELL(rcl_take_request(&service, &id, NULL));
  TELL(rcl_send_response(&service, NULL, &request));
  TELL(rcl_send_response(&service, &id, NULL));
  tell_qos("requests", rcl_service_request_subscription_get_actual_qos(&service));
  tell_qos("responses", rcl_service_response_publisher_get_actual_qos(&service));
  TELL(rcl_service_get_options(&service)->qos.depth);
  TELL(strcmp(rcl_service_get_service_name(&service), "/s/c"));
  TELL(rcl_service_fini(&service, &node));
  TELL(rcl_service_fini(&service, &node));
  TELL(rcl_service_is_valid(&service));
  TELL(rcl_take_request(&service, &id, &request));
  TELL(rcl_service_get_service_name(&service) != NULL);
  TELL(rcl_service_init(&service, &node, type, "c", &choices));
  TELL(rcl_service_fini(&service, &node));
}

static void clients(void)
{
  const rosidl_service_type_support_t * type = ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool);
  rcl_client_t client = rcl_get_zero_initialized_client();
  rcl_client_options_t choices = rcl_client_get_default_options();
  std_srvs__srv__SetBool_Request request;
  std_srvs__srv__SetBool_Response response;
  rmw_request_id_t id;
  int64_t number = 0;

  memset(&request, 0, sizeof(request));
  memset(&response, 0, sizeof(response));
  TELL(rcl_client_get_options(&client) != NULL);
  TELL(rcl_client_response_subscription_get_actual_qos(&client) != NULL);
  TELL(rcl_client_init(&client, &node, type, "d", &choices));
  TELL(rcl_client_init(&client, &node, type, "d", &choices));
  TELL(rcl_client_is_valid(&client));
  TELL(rcl_take_response(&client, &id, &response));
  TELL(rcl_take_response(&client, &id, NULL));
  TELL(rcl_send_request(&client, NULL, &number));
  TELL(rcl_send_request(&client, &request, NULL));
  TELL(rcl_send_request(&client, &request, &number));
  TELL(number);
  TELL(rcl_send_request(&client, &request, &number));
  TELL(number);
  TELL(rcl_take_response(&client, &id, &response));
  tell_qos("sent requests", rcl_client_request_publisher_get_actual_qos(&client));
  tell_qos("taken responses", rcl_client_response_subscription_get_actual_qos(&client));
  TELL(rcl_client_get_options(&client)->qos.history);
  TELL(rcl_client_fini(&client, &node));
  TELL(rcl_client_fini(&client, &node));
  TELL(rcl_client_is_valid(&client));
  TELL(rcl_send_request(&client, &request, &number));
  TELL(rcl_take_response(&client, &id, &response));
  TELL(rcl_client_init(&client, &node, type, "d", &choices));
  TELL(rcl_client_fini(&client, &node));
}

static void on_time(rcl_timer_t * timer, int64_t since)
{
  (void)timer;
  (void)since;
}

/* What nobody finalized before the context was shut down is no handle in the next one. */
static void old_handles(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_publisher_options_t sends = rcl_publisher_get_default_options();
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  std_msgs__msg__Int32 message;

  memset(&message, 0, sizeof(message));
  TELL(rcl_publisher_init(&publisher, &node, type, "/a", &sends));
  TELL(rcl_shutdown(&context));
  TELL(rcl_publish(&publisher, &message, NULL));
  TELL(rcl_publisher_is_valid(&publisher));
  TELL(rcl_publisher_fini(&publisher, &node));
  TELL(rcl_publisher_fini(&publisher, &node));
  TELL(rcl_node_fini(&node));
  TELL(rcl_context_fini(&context));
}

static void timers(void)
{
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  int64_t value = 0;
  bool flag = true;

  TELL(rcl_timer_init2(&timer, &clock_, &context, -1, on_time, allocator, true));
  TELL(rcl_timer_init2(&timer, NULL, &context, 5, on_time, allocator, true));
  TELL(rcl_timer_init2(&timer, &clock_, NULL, 5, on_time, allocator, true));
  TELL(rcl_timer_init2(NULL, &clock_, &context, 5, on_time, allocator, true));
  TELL(rcl_timer_init2(&timer, &clock_, &context, RCL_S_TO_NS(1000), on_time, allocator, true));
  TELL(rcl_timer_init2(&timer, &clock_, &context, RCL_S_TO_NS(1000), on_time, allocator, true));
  TELL(rcl_timer_is_ready(&timer, &flag));
  TELL(flag);
  TELL(rcl_timer_is_ready(&timer, NULL));
  TELL(rcl_timer_get_period(&timer, &value));
  TELL(value);
  TELL(rcl_timer_get_period(&timer, NULL));
  TELL(rcl_timer_exchange_period(&timer, 5, &value));
  TELL(value);
  TELL(rcl_timer_exchange_period(&timer, -5, &value));
  TELL(rcl_timer_exchange_period(&timer, 5, NULL));
  TELL(rcl_timer_get_time_until_next_call(&timer, NULL));
  TELL(rcl_timer_get_time_since_last_call(&timer, NULL));
  TELL(rcl_timer_call(&timer));
  TELL(rcl_timer_get_callback(&timer) == on_time);
  TELL(rcl_timer_exchange_callback(&timer, NULL) == on_time);
  TELL(rcl_timer_call(&timer));
  TELL(rcl_timer_is_canceled(&timer, &flag));
  TELL(flag);
  TELL(rcl_timer_cancel(&timer));
  TELL(rcl_timer_cancel(&timer));
  TELL(rcl_timer_is_canceled(&timer, &flag));
  TELL(flag);
  TELL(rcl_timer_call(&timer));
  TELL(rcl_timer_is_ready(&timer, &flag));
  TELL(flag);
  TELL(rcl_timer_get_time_until_next_call(&timer, &value));
  TELL(rcl_timer_reset(&timer));
  TELL(rcl_timer_is_canceled(&timer, &flag));
  TELL(flag);
  TELL(rcl_timer_call(&timer));
  TELL(rcl_timer_fini(&timer));
  TELL(rcl_timer_fini(&timer));
  TELL(rcl_timer_call(&timer));
  TELL(rcl_timer_cancel(&timer));
  TELL(rcl_timer_reset(&timer));
  TELL(rcl_timer_get_period(&timer, &value));
  TELL(rcl_timer_init2(&timer, &clock_, &context, RCL_S_TO_NS(1000), NULL, allocator, false));
  TELL(rcl_timer_is_canceled(&timer, &flag));
  TELL(flag);
  TELL(rcl_timer_fini(&timer));
}

static void guards(void)
{
  rcl_guard_condition_options_t choices = rcl_guard_condition_get_default_options();
  rcl_guard_condition_t guard = rcl_get_zero_initialized_guard_condition();

  TELL(rcl_guard_condition_init(&guard, &context, choices));
  TELL(rcl_guard_condition_init(&guard, &context, choices));
  TELL(rcl_trigger_guard_condition(&guard));
  TELL(rcl_trigger_guard_condition(&guard));
  TELL(rcl_guard_condition_fini(&guard));
  TELL(rcl_guard_condition_fini(&guard));
  TELL(rcl_trigger_guard_condition(&guard));
  TELL(rcl_guard_condition_init(&guard, &context, choices));
  TELL(rcl_guard_condition_fini(&guard));
}

static void wait_sets(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_guard_condition_options_t choices = rcl_guard_condition_get_default_options();
  rcl_guard_condition_t guard = rcl_get_zero_initialized_guard_condition();
  rcl_subscription_t subscription = rcl_get_zero_initialized_subscription();
  rcl_subscription_options_t takes = rcl_subscription_get_default_options();
  rcl_wait_set_t set = rcl_get_zero_initialized_wait_set();
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  size_t index = 7;

  TELL(rcl_guard_condition_init(&guard, &context, choices));
  TELL(rcl_subscription_init(&subscription, &node, type, "/b", &takes));
  TELL(rcl_timer_init2(&timer, &clock_, &context, RCL_S_TO_NS(1000), on_time, allocator, true));
  TELL(rcl_wait_set_init(&set, 0, 0, 0, 0, 0, 0, &context, heap));
  TELL(rcl_wait_set_init(&set, 0, 0, 0, 0, 0, 0, &context, heap));
  TELL(rcl_wait_set_is_valid(&set));
  TELL(rcl_wait(&set, 0));
  TELL(rcl_wait_set_add_subscription(&set, &subscription, &index));
  TELL(rcl_wait_set_add_guard_condition(&set, &guard, &index));
  TELL(rcl_wait_set_add_timer(&set, &timer, &index));
  TELL(rcl_wait_set_clear(&set));
  TELL(rcl_wait_set_fini(&set));
  TELL(rcl_wait_set_fini(&set));
  TELL(rcl_wait_set_is_valid(&set));
  TELL(rcl_wait(&set, 0));
  TELL(rcl_wait_set_clear(&set));
  TELL(rcl_wait_set_init(&set, 1, 1, 1, 0, 0, 0, &context, heap));
  TELL(rcl_wait(&set, 0));
  TELL(rcl_wait_set_add_subscription(&set, NULL, &index));
  TELL(rcl_wait_set_add_subscription(&set, &subscription, &index));
  TELL(index);
  TELL(rcl_wait_set_add_subscription(&set, &subscription, NULL));
  TELL(rcl_wait(&set, 0));
  TELL(set.subscriptions[0] != NULL);
  TELL(rcl_wait_set_clear(&set));
  TELL(rcl_wait_set_add_timer(&set, &timer, &index));
  TELL(rcl_wait(&set, RCL_MS_TO_NS(1)));
  TELL(rcl_wait_set_clear(&set));
  TELL(rcl_wait_set_add_guard_condition(&set, &guard, &index));
  TELL(rcl_trigger_guard_condition(&guard));
  TELL(rcl_wait(&set, RCL_MS_TO_NS(1000)));
  TELL(set.guard_conditions[0] == &guard);
  TELL(rcl_wait_set_resize(&set, 0, 1, 0, 0, 0, 0));
  TELL(set.size_of_subscriptions);
  TELL(rcl_wait_set_add_subscription(&set, &subscription, &index));
  TELL(rcl_wait_set_resize(NULL, 0, 1, 0, 0, 0, 0));
  TELL(rcl_wait_set_fini(&set));
  TELL(rcl_wait_set_resize(&set, 0, 1, 0, 0, 0, 0));
  TELL(rcl_timer_fini(&timer));
  TELL(rcl_subscription_fini(&subscription, &node));
  TELL(rcl_guard_condition_fini(&guard));
}

/* Calls after a shutdown. */
static void shut_down(void)
{
  const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32);
  rcl_guard_condition_t guard = rcl_get_zero_initialized_guard_condition();
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  rcl_publisher_t late = rcl_get_zero_initialized_publisher();
  rcl_subscription_t subscription = rcl_get_zero_initialized_subscription();
  rcl_publisher_options_t sends = rcl_publisher_get_default_options();
  rcl_subscription_options_t takes = rcl_subscription_get_default_options();
  rcl_node_options_t choices = rcl_node_get_default_options();
  rcl_wait_set_t set = rcl_get_zero_initialized_wait_set();
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  rcl_timer_t late_timer = rcl_get_zero_initialized_timer();
  rcl_node_t late_node = rcl_get_zero_initialized_node();
  std_msgs__msg__Int32 message;

  memset(&message, 0, sizeof(message));
  TELL(rcl_guard_condition_init(&guard, &context, rcl_guard_condition_get_default_options()));
  TELL(rcl_publisher_init(&publisher, &node, type, "/a", &sends));
  TELL(rcl_subscription_init(&subscription, &node, type, "/b", &takes));
  TELL(rcl_timer_init2(&timer, &clock_, &context, RCL_S_TO_NS(1000), on_time, allocator, true));
  TELL(rcl_wait_set_init(&set, 1, 1, 0, 0, 0, 0, &context, heap));
  TELL(rcl_shutdown(&context));
  TELL(rcl_context_is_valid(&context));
  TELL(rcl_context_get_instance_id(&context) != 0u);
  TELL(rcl_shutdown(&context));
  TELL(rcl_node_is_valid(&node));
  TELL(rcl_node_is_valid_except_context(&node));
  TELL(rcl_node_get_name(&node) != NULL);
  TELL(rcl_publisher_is_valid(&publisher));
  TELL(rcl_publisher_is_valid_except_context(&publisher));
  TELL(rcl_publish(&publisher, &message, NULL));
  TELL(rcl_publisher_init(&late, &node, type, "/a", &sends));
  TELL(rcl_node_init(&late_node, "late", "", &context, &choices));
  TELL(rcl_timer_init2(&late_timer, &clock_, &context, 5, on_time, allocator, true));
  TELL(rcl_subscription_is_valid(&subscription));
  TELL(rcl_take(&subscription, &message, NULL, NULL));
  TELL(rcl_wait_set_add_guard_condition(&set, &guard, NULL));
  TELL(rcl_trigger_guard_condition(&guard));
  TELL(rcl_wait(&set, RCL_MS_TO_NS(1)));
  TELL(rcl_timer_cancel(&timer));
  TELL(rcl_wait_set_fini(&set));
  TELL(rcl_timer_fini(&timer));
  TELL(rcl_subscription_fini(&subscription, &node));
  TELL(rcl_publisher_fini(&publisher, &node));
  TELL(rcl_guard_condition_fini(&guard));
  TELL(rcl_node_fini(&node));
  TELL(rcl_node_fini(&node));
  TELL(rcl_context_fini(&context));
  TELL(rcl_context_fini(&context));
  TELL(rcl_context_is_valid(&context));
  TELL(rcl_shutdown(&context));
}

int main(void)
{
  allocator = heap;
  start();
  names();
  publishers();
  subscriptions();
  services();
  clients();
  TELL(rcl_clock_init(RCL_STEADY_TIME, &clock_, &allocator));
  timers();
  guards();
  wait_sets();
  shut_down();
  start(); /* everything again */
  old_handles();
  start();
  guards();
  publishers();
  shut_down();
  TELL(rcl_clock_fini(&clock_));
  TELL(rcl_clock_fini(&clock_));
  return 0;
}
