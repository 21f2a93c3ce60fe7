/* SPDX-License-Identifier: Apache-2.0 */
/* Calls that need no agent, and what each returns: compiled against ROS 2's librcl and against the generated library. */
#include "tell.h"

#include <rcl/domain_id.h>
#include <rcl/expand_topic_name.h>
#include <rcl/guard_condition.h>
#include <rcl/rcl.h>
#include <rcl/time.h>
#include <rcl/timer.h>
#include <rcl/validate_topic_name.h>
#include <rcl/wait.h>
#include <rcutils/snprintf.h>
#include <rcutils/types/string_array.h>
#include <rcutils/types/string_map.h>
#include <rmw/time.h>
#include <string.h>

static void options(void)
{
  rcl_init_options_t a = rcl_get_zero_initialized_init_options();
  rcl_init_options_t b = rcl_get_zero_initialized_init_options();
  size_t domain = 7;

  TELL(rcl_init_options_init(NULL, heap));
  TELL(rcl_init_options_fini(&a));
  TELL(rcl_init_options_fini(NULL));
  TELL(rcl_init_options_get_domain_id(&a, &domain));
  TELL(rcl_init_options_init(&a, heap));
  TELL(rcl_init_options_init(&a, heap));
  TELL(rcl_init_options_get_domain_id(&a, &domain));
  TELL(domain == RCL_DEFAULT_DOMAIN_ID);
  TELL(rcl_init_options_get_domain_id(&a, NULL));
  TELL(rcl_init_options_set_domain_id(&a, 42));
  TELL(rcl_init_options_set_domain_id(NULL, 42));
  TELL(rcl_init_options_copy(&a, &b));
  TELL(rcl_init_options_copy(&a, &b));
  TELL(rcl_init_options_copy(&a, NULL));
  TELL(rcl_init_options_copy(NULL, &b));
  TELL(rcl_init_options_get_domain_id(&b, &domain));
  TELL(domain);
  TELL(rcl_init_options_get_rmw_init_options(&a) != NULL);
  TELL(rcl_init_options_get_rmw_init_options(NULL) != NULL);
  TELL(rcl_init_options_get_allocator(&a) != NULL);
  TELL(rcl_init_options_get_allocator(NULL) != NULL);
  TELL(rcl_init_options_fini(&b));
  TELL(rcl_init_options_fini(&a));
  TELL(rcl_init_options_fini(&a));
  TELL(rcl_get_default_domain_id(NULL));
  TELL(rcl_get_default_domain_id(&domain));
  TELL(domain == RCL_DEFAULT_DOMAIN_ID);
}

static void contexts(void)
{
  rcl_context_t context = rcl_get_zero_initialized_context();
  rcl_init_options_t none = rcl_get_zero_initialized_init_options();
  size_t domain = 0;

  TELL(rcl_init(0, NULL, NULL, &context));
  TELL(rcl_init(0, NULL, &none, &context));
  TELL(rcl_init(0, NULL, &none, NULL));
  TELL(rcl_shutdown(NULL));
  TELL(rcl_shutdown(&context));
  TELL(rcl_context_fini(NULL));
  TELL(rcl_context_fini(&context));
  TELL(rcl_context_is_valid(NULL));
  TELL(rcl_context_is_valid(&context));
  TELL(rcl_context_get_instance_id(&context));
  TELL(rcl_context_get_domain_id(&context, &domain));
  TELL(rcl_context_get_rmw_context(&context) != NULL);
}

static void nodes(void)
{
  rcl_context_t context = rcl_get_zero_initialized_context();
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_node_options_t choices = rcl_node_get_default_options();
  size_t domain = 0;

  TELL(rcl_node_init(NULL, "a", "", &context, &choices));
  TELL(rcl_node_init(&node, NULL, "", &context, &choices));
  TELL(rcl_node_init(&node, "a", NULL, &context, &choices));
  TELL(rcl_node_init(&node, "a", "", NULL, &choices));
  TELL(rcl_node_init(&node, "a", "", &context, NULL));
  TELL(rcl_node_init(&node, "a", "", &context, &choices));
  TELL(rcl_node_fini(NULL));
  TELL(rcl_node_fini(&node));
  TELL(rcl_node_is_valid(NULL));
  TELL(rcl_node_is_valid(&node));
  TELL(rcl_node_is_valid_except_context(&node));
  TELL(rcl_node_get_name(&node) != NULL);
  TELL(rcl_node_get_namespace(NULL) != NULL);
  TELL(rcl_node_get_domain_id(&node, &domain));
  TELL(rcl_node_get_rmw_handle(&node) != NULL);
  TELL(choices.use_global_arguments);
  TELL(rcl_node_options_fini(NULL));
  TELL(rcl_node_options_fini(&choices));
}

static void endpoints(void)
{
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_publisher_t publisher = rcl_get_zero_initialized_publisher();
  rcl_subscription_t subscription = rcl_get_zero_initialized_subscription();
  rcl_publisher_options_t sends = rcl_publisher_get_default_options();
  rcl_subscription_options_t takes = rcl_subscription_get_default_options();
  int message = 0;

  TELL(rcl_publisher_init(&publisher, &node, NULL, "a", &sends));
  TELL(rcl_publisher_init(NULL, &node, NULL, "a", &sends));
  TELL(rcl_publisher_fini(NULL, &node));
  TELL(rcl_publisher_fini(&publisher, NULL));
  TELL(rcl_publisher_fini(&publisher, &node));
  TELL(rcl_publish(NULL, &message, NULL));
  TELL(rcl_publish(&publisher, &message, NULL));
  TELL(rcl_publish_serialized_message(&publisher, NULL, NULL));
  TELL(rcl_publisher_wait_for_all_acked(&publisher, 0));
  TELL(rcl_publisher_is_valid(&publisher));
  TELL(rcl_publisher_is_valid(NULL));
  TELL(rcl_publisher_get_topic_name(&publisher) != NULL);
  TELL(rcl_publisher_get_rmw_handle(NULL) != NULL);
  TELL(sends.qos.depth);
  TELL(sends.qos.reliability);
  TELL(sends.disable_loaned_message);
  TELL(rcl_subscription_init(&subscription, &node, NULL, "a", &takes));
  TELL(rcl_subscription_init(NULL, &node, NULL, "a", &takes));
  TELL(rcl_subscription_fini(NULL, &node));
  TELL(rcl_subscription_fini(&subscription, NULL));
  TELL(rcl_take(NULL, &message, NULL, NULL));
  TELL(rcl_take(&subscription, &message, NULL, NULL));
  TELL(rcl_take_serialized_message(&subscription, NULL, NULL, NULL));
  TELL(rcl_subscription_is_valid(&subscription));
  TELL(rcl_subscription_get_topic_name(NULL) != NULL);
  TELL(takes.qos.durability);
}

static void services(void)
{
  rcl_node_t node = rcl_get_zero_initialized_node();
  rcl_client_t client = rcl_get_zero_initialized_client();
  rcl_service_t service = rcl_get_zero_initialized_service();
  rcl_client_options_t asks = rcl_client_get_default_options();
  rcl_service_options_t answers = rcl_service_get_default_options();
  rmw_request_id_t id;
  int64_t number = 0;
  int message = 0;

  TELL(rcl_client_init(NULL, &node, NULL, "a", &asks));
  TELL(rcl_client_init(&client, &node, NULL, "a", &asks));
  TELL(rcl_client_fini(NULL, &node));
  TELL(rcl_client_fini(&client, NULL));
  TELL(rcl_client_fini(&client, &node));
  TELL(rcl_send_request(NULL, &message, &number));
  TELL(rcl_send_request(&client, &message, &number));
  TELL(rcl_take_response(NULL, &id, &message));
  TELL(rcl_take_response(&client, &id, &message));
  TELL(rcl_client_is_valid(&client));
  TELL(rcl_client_is_valid(NULL));
  TELL(rcl_client_get_service_name(&client) != NULL);
  TELL(asks.qos.depth);
  TELL(rcl_service_init(NULL, &node, NULL, "a", &answers));
  TELL(rcl_service_init(&service, &node, NULL, "a", &answers));
  TELL(rcl_service_fini(NULL, &node));
  TELL(rcl_service_fini(&service, NULL));
  TELL(rcl_service_fini(&service, &node));
  TELL(rcl_take_request(NULL, &id, &message));
  TELL(rcl_take_request(&service, &id, &message));
  TELL(rcl_send_response(NULL, &id, &message));
  TELL(rcl_send_response(&service, &id, &message));
  TELL(rcl_service_is_valid(&service));
  TELL(rcl_service_get_service_name(NULL) != NULL);
  TELL(answers.qos.reliability);
}

static void clocks(void)
{
  rcl_allocator_t allocator = heap;
  rcl_clock_t clock;
  rcl_time_point_value_t now = 0;
  rcl_time_point_t a = {5, RCL_STEADY_TIME};
  rcl_time_point_t b = {9, RCL_SYSTEM_TIME};
  rcl_duration_t delta = {0};

  memset(&clock, 0, sizeof(clock));
  TELL(rcl_clock_valid(&clock));
  TELL(rcl_clock_get_now(NULL, &now));
  TELL(rcl_clock_get_now(&clock, &now));
  TELL(rcl_clock_init(RCL_STEADY_TIME, NULL, &allocator));
  TELL(rcl_clock_init(RCL_STEADY_TIME, &clock, NULL));
  TELL(rcl_clock_init(RCL_STEADY_TIME, &clock, &allocator));
  TELL(rcl_clock_valid(&clock));
  TELL(rcl_clock_get_now(&clock, NULL));
  TELL(rcl_clock_get_now(&clock, &now));
  TELL(now > 0);
  TELL(rcl_ros_clock_fini(&clock));
  TELL(rcl_enable_ros_time_override(&clock));
  TELL(rcl_difference_times(&a, &b, &delta));
  b.clock_type = RCL_STEADY_TIME;
  TELL(rcl_difference_times(&a, &b, &delta));
  TELL(delta.nanoseconds);
  TELL(rcl_difference_times(NULL, &b, &delta));
  TELL(rcl_clock_fini(NULL));
  TELL(rcl_clock_fini(&clock));
}

static void waiting(void)
{
  rcl_context_t context = rcl_get_zero_initialized_context();
  rcl_wait_set_t set = rcl_get_zero_initialized_wait_set();
  rcl_guard_condition_t guard = rcl_get_zero_initialized_guard_condition();
  rcl_guard_condition_options_t choices = rcl_guard_condition_get_default_options();
  rcl_timer_t timer = rcl_get_zero_initialized_timer();
  rcl_allocator_t allocator;
  int64_t value = 0;
  bool flag = false;

  TELL(rcl_wait_set_init(NULL, 0, 0, 0, 0, 0, 0, &context, heap));
  TELL(rcl_wait_set_init(&set, 0, 0, 0, 0, 0, 0, NULL, heap));
  TELL(rcl_wait_set_init(&set, 0, 0, 0, 0, 0, 0, &context, heap));
  TELL(rcl_wait_set_fini(&set));
  TELL(rcl_wait_set_fini(NULL));
  TELL(rcl_wait_set_is_valid(&set));
  TELL(rcl_wait_set_is_valid(NULL));
  TELL(rcl_wait_set_clear(NULL));
  TELL(rcl_wait_set_clear(&set));
  TELL(rcl_wait_set_get_allocator(NULL, &allocator));
  TELL(rcl_wait_set_get_allocator(&set, &allocator));
  TELL(rcl_wait_set_add_guard_condition(NULL, &guard, NULL));
  TELL(rcl_wait_set_add_guard_condition(&set, &guard, NULL));
  TELL(rcl_wait_set_add_timer(&set, &timer, NULL));
  TELL(rcl_wait(NULL, 0));
  TELL(rcl_wait(&set, 0));
  TELL(rcl_guard_condition_init(NULL, &context, choices));
  TELL(rcl_guard_condition_init(&guard, NULL, choices));
  TELL(rcl_guard_condition_init(&guard, &context, choices));
  TELL(rcl_guard_condition_fini(NULL));
  TELL(rcl_guard_condition_fini(&guard));
  TELL(rcl_trigger_guard_condition(NULL));
  TELL(rcl_trigger_guard_condition(&guard));
  TELL(rcl_timer_fini(NULL));
  TELL(rcl_timer_fini(&timer));
  TELL(rcl_timer_call(NULL));
  TELL(rcl_timer_call(&timer));
  TELL(rcl_timer_is_ready(&timer, &flag));
  TELL(rcl_timer_get_time_until_next_call(&timer, &value));
  TELL(rcl_timer_get_period(&timer, &value));
  TELL(rcl_timer_exchange_period(&timer, 5, &value));
  TELL(rcl_timer_cancel(NULL));
  TELL(rcl_timer_cancel(&timer));
  TELL(rcl_timer_is_canceled(&timer, &flag));
  TELL(rcl_timer_reset(&timer));
  TELL(rcl_timer_get_callback(&timer) != NULL);
}

static void texts(void)
{
  rcutils_string_array_t a = rcutils_get_zero_initialized_string_array();
  rcutils_string_array_t b = rcutils_get_zero_initialized_string_array();
  char small[4];
  int order = 7;
  const rmw_time_t odd = {1, 2500000000u};
  const rmw_time_t forever = RMW_DURATION_INFINITE;
  const rmw_time_t huge = {UINT64_MAX, 0};

  TELL(rcutils_string_array_fini(NULL));
  TELL(rcutils_string_array_fini(&a));
  TELL(rcutils_string_array_init(NULL, 2, &heap));
  TELL(rcutils_string_array_init(&a, 2, NULL));
  TELL(rcutils_string_array_init(&a, 2, &heap));
  TELL(rcutils_string_array_init(&b, 0, &heap));
  TELL(rcutils_string_array_cmp(&a, &b, &order));
  TELL(order);
  TELL(rcutils_string_array_resize(&b, 2));
  TELL(rcutils_string_array_cmp(&a, &b, &order));
  a.data[0] = heap_zero(1, 2, NULL);
  b.data[0] = heap_zero(1, 2, NULL);
  b.data[0][0] = 'b';
  TELL(rcutils_string_array_cmp(&a, &b, &order));
  TELL(order < 0);
  TELL(rcutils_string_array_sort_compare(&a.data[1], &b.data[0]));
  TELL(rcutils_string_array_sort_compare(&b.data[0], &a.data[1]));
  TELL(rcutils_string_array_sort_compare(&b.data[0], &a.data[0]) > 0);
  TELL(rcutils_string_array_resize(&b, 1));
  TELL(b.size);
  TELL(rcutils_string_array_resize(NULL, 1));
  TELL(rcutils_string_array_fini(&b));
  TELL(rcutils_string_array_fini(&a));
  TELL(a.size);
  TELL(rcutils_snprintf(small, sizeof(small), "%d", 123456));
  TELL(strlen(small));
  TELL(rcutils_snprintf(NULL, 0, "%d", 123456));
  TELL(rcutils_snprintf(small, 0, "%d", 1));
  TELL(rcutils_snprintf(small, sizeof(small), NULL));
  TELL(rmw_time_total_nsec(odd));
  TELL(rmw_time_total_nsec(forever) == INT64_MAX);
  TELL(rmw_time_total_nsec(huge) == INT64_MAX);
  TELL(rmw_time_equal(huge, forever));
  TELL(rmw_time_normalize(odd).sec);
  TELL(rmw_time_normalize(odd).nsec);
  TELL(rmw_time_from_nsec(-1).sec);
}

static void maps(void)
{
  rcutils_string_map_t a = rcutils_get_zero_initialized_string_map();
  rcutils_string_map_t b = rcutils_get_zero_initialized_string_map();
  const rcl_allocator_t none = rcutils_get_zero_initialized_allocator();
  const char * key;
  size_t size = 7;

  TELL(rcutils_string_map_init(NULL, 0, heap));
  TELL(rcutils_string_map_init(&a, 0, none));
  TELL(rcutils_string_map_get_size(&a, &size));
  TELL(rcutils_string_map_set(&a, "x", "1"));
  TELL(rcutils_string_map_unset(&a, "x"));
  TELL(rcutils_string_map_clear(&a));
  TELL(rcutils_string_map_reserve(&a, 3));
  TELL(rcutils_string_map_key_exists(&a, "x"));
  TELL(rcutils_string_map_get(&a, "x") != NULL);
  TELL(rcutils_string_map_get_next_key(&a, NULL) != NULL);
  TELL(rcutils_string_map_fini(&a));
  TELL(rcutils_string_map_fini(NULL));
  TELL(rcutils_string_map_init(&a, 1, heap));
  TELL(rcutils_string_map_init(&a, 1, heap));
  TELL(rcutils_string_map_set(&a, NULL, "1"));
  TELL(rcutils_string_map_set(&a, "x", NULL));
  TELL(rcutils_string_map_set(NULL, "x", "1"));
  TELL(rcutils_string_map_set(&a, "x", "1"));
  TELL(rcutils_string_map_set_no_resize(&a, "xy", "2"));
  TELL(rcutils_string_map_set_no_resize(&a, "x", "3"));
  TELL(rcutils_string_map_set(&a, "xy", "2"));
  TELL(rcutils_string_map_set(&a, "xyz", "4"));
  TELL(rcutils_string_map_get_size(&a, &size));
  TELL(size);
  TELL(rcutils_string_map_get_capacity(&a, &size));
  TELL(size);
  TELL(rcutils_string_map_get_capacity(&a, NULL));
  TELL(rcutils_string_map_get(&a, "x")[0]);
  TELL(rcutils_string_map_getn(&a, "xyz", 2)[0]);
  TELL(rcutils_string_map_key_existsn(&a, "xyzzy", 3));
  TELL(rcutils_string_map_key_existsn(&a, "y", 1));
  TELL(rcutils_string_map_unset(&a, "y"));
  TELL(rcutils_string_map_unset(&a, NULL));
  TELL(rcutils_string_map_copy(&a, &b));
  TELL(rcutils_string_map_init(&b, 0, heap));
  TELL(rcutils_string_map_copy(&a, &b));
  TELL(rcutils_string_map_copy(NULL, &b));
  TELL(rcutils_string_map_unset(&b, "xyz"));
  TELL(rcutils_string_map_unset(&b, "xyz"));
  key = rcutils_string_map_get_next_key(&b, NULL);
  TELL(strcmp(key, "x"));
  key = rcutils_string_map_get_next_key(&b, key);
  TELL(strcmp(key, "xy"));
  TELL(rcutils_string_map_get_next_key(&b, key) != NULL);
  TELL(rcutils_string_map_reserve(&b, 1));
  TELL(rcutils_string_map_get_capacity(&b, &size));
  TELL(size);
  TELL(rcutils_string_map_clear(&b));
  TELL(rcutils_string_map_get_next_key(&b, NULL) != NULL);
  TELL(rcutils_string_map_fini(&b));
  TELL(rcutils_string_map_fini(&b));
  TELL(rcutils_string_map_fini(&a));
}

static void expand(const char * topic, const char * node, const char * space)
{
  rcutils_string_map_t map = rcutils_get_zero_initialized_string_map();
  char * full = NULL;

  if (rcutils_string_map_init(&map, 0, heap) != 0 || rcutils_string_map_set(&map, "x", "/v") != 0) {
    exit(1);
  }
  SAY(
    "'%s' of '%s' in '%s' %ld\n", topic, node, space,
    (long)rcl_expand_topic_name(topic, node, space, &map, heap, &full));
  SAY("'%s' 0\n", full != NULL ? full : "");
  free(full);
  rcl_reset_error();
  TELL(rcutils_string_map_fini(&map));
}

static void names(void)
{
  static const char * const topics[] = {
    "a",      "/a",    "~",     "~/a",  "",    "a/", "1a", "a/1", "a b",  "a~",
    "{node}", "{ns}",  "{x}",   "a{x}", "{y}", "{x", "x}", "{1}", "a{/}", "{namespace}/{node}",
    "a//b",   "{{a}}", "~a{x}", "/~/a", "/"};
  char many[300];
  rcutils_string_map_t none = rcutils_get_zero_initialized_string_map();
  char * full = NULL;
  int result = 0;
  size_t index = 0;

  for (size_t i = 0; i < sizeof(topics) / sizeof(topics[0]); ++i) {
    SAY("topic '%s' 0\n", topics[i]);
    TELL(rcl_validate_topic_name(topics[i], &result, &index));
    TELL(result);
    TELL(index);
    TELL(rcl_topic_name_validation_result_string(result) != NULL);
    expand(topics[i], "n", "/");
    expand(topics[i], "n", "/s/t");
  }
  TELL(rcl_validate_topic_name(NULL, &result, &index));
  TELL(rcl_validate_topic_name("a", NULL, &index));
  TELL(rcl_validate_topic_name("~1", &result, NULL));
  TELL(rcl_validate_topic_name_with_size("a/b", 2, &result, NULL));
  TELL(result);
  TELL(rcl_topic_name_validation_result_string(77) != NULL);
  expand("a", "", "/");
  expand("a", "n/", "/");
  expand("a", "1", "/");
  expand("a", "n", "");
  expand("a", "n", "s");
  expand("a", "n", "/s/");
  memset(many, 'a', sizeof(many));
  many[0] = '/';
  many[246] = '\0';
  expand("a", "n", many);
  expand("a", &many[1], "/");
  many[246] = 'a';
  many[256] = '\0';
  expand("a", &many[1], "/");
  expand("a", "n", many);
  many[256] = 'a';
  many[257] = '\0';
  expand("a", &many[1], "/");
  expand(many, "n", "/");
  TELL(rcl_expand_topic_name(NULL, "n", "/", &none, heap, &full));
  TELL(rcl_expand_topic_name("a", NULL, "/", &none, heap, &full));
  TELL(rcl_expand_topic_name("a", "n", NULL, &none, heap, &full));
  TELL(rcl_expand_topic_name("a", "n", "/", NULL, heap, &full));
  TELL(rcl_expand_topic_name("a", "n", "/", &none, heap, NULL));
  TELL(rcl_get_default_topic_name_substitutions(NULL));
  TELL(rcl_get_default_topic_name_substitutions(&none));
  TELL(rcl_node_resolve_name(NULL, "a", heap, false, false, &full));
}

int main(void)
{
  options();
  contexts();
  nodes();
  endpoints();
  services();
  clocks();
  waiting();
  texts();
  maps();
  names();
  return 0;
}
