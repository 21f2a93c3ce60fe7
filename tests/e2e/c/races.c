/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The example of an application (RACES_EXAMPLE, its main.c) with further tasks, which call whatever several tasks may
 * call, until the standard input ends. Prints how often each call succeeded. Components that an application does not
 * have are left out: RACES_<COMPONENT> says what it has, and KIND_<name> is the variable of an entity in the example.
 */
#define main example_main
#define EXAMPLE_SAMPLES races_limit()

#include <stdint.h>

#include <microros/tasks.h>

static uint32_t races_limit(void);
static rcl_ret_t races_start(void);
static rcl_ret_t races_stop(void);

#define rclc_tasks_start() races_start()
#define rclc_tasks_stop() races_stop()

#include RACES_EXAMPLE

#undef main

#include <pthread.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>
#include <wchar.h>

#include <rmw_microros/rmw_microros.h>
#include <rcl/wait.h>
#ifdef RACES_TF_BROADCASTER
#include <rclc_tf/rclc_tf.h>
#endif
#ifdef RACES_CLOCK_STAMP
#include <rclc/stamp.h>
#endif
#ifdef RACES_GRAPH
#include <rcl/graph.h>
#endif
#ifdef RACES_QOS_EVENTS
#include <rcl/event.h>
#endif
#ifdef RACES_SERVICE_CALL
#include <rclc/service_call.h>
#endif
#ifdef RACES_EXECUTOR_NODES
#include <rclc/executor_nodes.h>
#endif
#ifdef RACES_MICRO_ROS_UTILITIES
#include <micro_ros_utilities/type_utilities.h>
#endif
#ifdef RACES_PARAMETER_STORAGE
#include <rclc_parameter/parameter_storage.h>
#endif
#ifdef RACES_DIAGNOSIS
#include <rclc_diagnosis/callbacks.h>
#include <rclc_diagnosis/rclc_diagnosis.h>
#endif

enum { THREADS = 4, NAMES = 64, HUGE_SIZE = 5000, PART = 100, EMPTY = 5 };

typedef struct outcome_t {
  const char * name;
  uint32_t succeeded;
  uint32_t called;
  char error[160]; /* of the last call that failed */
} outcome_t;

static outcome_t outcomes[NAMES];
static bool ends; /* with the lock */

/* Counts a call by its name; returns whether it succeeded. */
static bool count(const char * name, bool succeeded)
{
  size_t at = 0;

  port_lock(); /* callbacks count as well, some of them with this lock */
  while (at < NAMES - 1 && outcomes[at].name != NULL && strcmp(outcomes[at].name, name) != 0) {
    ++at;
  }
  outcomes[at].name = name;
  outcomes[at].succeeded += succeeded ? 1u : 0u;
  outcomes[at].called += 1u;
  if (!succeeded) {
    (void)snprintf(outcomes[at].error, sizeof(outcomes[at].error), "%s", rcl_get_error_string().str);
    rcl_reset_error();
  }
  port_unlock();
  return succeeded;
}

#define DO(call) (void)count(#call, (call) == RCL_RET_OK)
#define TRUE(condition) (void)count(#condition, (condition))

static bool has_ended(void)
{
  bool ended;

  port_lock();
  ended = ends;
  port_unlock();
  return ended;
}

static void end(void)
{
  port_lock();
  ends = true;
  port_unlock();
}

static uint32_t races_limit(void)
{
  struct pollfd input = {.fd = STDIN_FILENO, .events = POLLIN};

  return poll(&input, 1, 0) > 0 ? 0u : UINT32_MAX;
}

#ifdef RACES_CONTINUOUS_SERIALIZATION
static void huge_size(uint32_t * length)
{
  *length += HUGE_SIZE;
}

static void huge_text(ucdrBuffer * buffer)
{
  uint8_t part[PART];

  (void)memset(part, 'x', sizeof(part));
  buffer->iterator -= EMPTY;
  buffer->offset -= EMPTY;
  (void)ucdr_serialize_uint32_t(buffer, HUGE_SIZE + 1u);
  for (uint32_t done = 0; done < HUGE_SIZE; done += PART) {
    (void)ucdr_serialize_array_uint8_t(buffer, part, PART);
  }
  (void)ucdr_serialize_uint8_t(buffer, 0);
}
#endif

#ifdef RACES_TF_BROADCASTER
static rclc_tf_broadcaster_t transforms;
static rclc_static_tf_broadcaster_t fixed;
static geometry_msgs__msg__TransformStamped transform;
#endif

/* Opens what the example does not have: every entity is open before the tasks run. */
static void open_more(void)
{
#ifdef RACES_TF_BROADCASTER
  static char frame[] = "map";
  static char child[] = "base";

  DO(rclc_tf_broadcaster_init(&transforms, &node));
  DO(rclc_static_tf_broadcaster_init(&fixed, &node));
  DO(rclc_tf_set_frames(&transform, frame, child));
#endif
#ifdef RACES_CONTINUOUS_SERIALIZATION
  rmw_uros_set_continous_serialization_callbacks(
    rcl_publisher_get_rmw_handle(&PUBLISHER_huge), huge_size, huge_text);
#endif
}

static void close_more(void)
{
#ifdef RACES_TF_BROADCASTER
  DO(rclc_static_tf_broadcaster_fini(&fixed, &node));
  DO(rclc_tf_broadcaster_fini(&transforms, &node));
#endif
}

/* Publishes, and asks for what is counted. */
static void write_once(uint32_t turn)
{
  std_msgs__msg__Int32 number = {.data = (int32_t)turn};
  rmw_uros_statistics_t statistics;
  rmw_uros_subscription_statistics_t of_subscription;

  DO(rcl_publish(&PUBLISHER_count, &number, NULL));
  DO(rcl_publish(&PUBLISHER_fast, &number, NULL));
#ifdef RACES_PEER
  DO(rcl_publish(&PUBLISHER_peer_out, &number, NULL));
#endif
  DO(rmw_uros_get_statistics(rcl_context_get_rmw_context(&support.context), &statistics));
  DO(rmw_uros_get_subscription_statistics(
    rcl_subscription_get_rmw_handle(&SUBSCRIPTION_target), &of_subscription));
#ifdef RACES_PUBLISH_STATISTICS
  {
    rmw_uros_publisher_statistics_t of_publisher;
    DO(rmw_uros_get_publisher_statistics(rcl_publisher_get_rmw_handle(&PUBLISHER_count), &of_publisher));
  }
#endif
#ifdef RACES_CONTINUOUS_SERIALIZATION
  if (turn % 16u == 0u) {
    static std_msgs__msg__String unused;
    DO(rcl_publish(&PUBLISHER_huge, &unused, NULL));
  }
#endif
#ifdef RACES_TF_BROADCASTER
  DO(rclc_tf_broadcaster_send(&transforms, &transform, 1));
  if (turn % 16u == 0u) {
    DO(rclc_static_tf_broadcaster_send(&fixed, &transform, 1));
  }
#endif
#ifdef RACES_MICRO_ROS_UTILITIES
  {
    static std_msgs__msg__String text;
    static const micro_ros_utilities_memory_conf_t rules = {.max_string_capacity = 8};
    const rosidl_message_type_support_t * type = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, String);

    (void)memset(&text, 0, sizeof(text));
    if (count("create_message_memory", micro_ros_utilities_create_message_memory(type, &text, rules))) {
      TRUE(micro_ros_utilities_destroy_message_memory(type, &text, rules));
    }
  }
#endif
  if (turn % 64u == 0u) {
    DO(rcl_publisher_wait_for_all_acked(&PUBLISHER_count, RCL_MS_TO_NS(20)));
  }
}

/* Logs, and reads and sets what belongs to the device. */
static void log_once(uint32_t turn)
{
  static const wchar_t wide[] = L"wide";

  RCUTILS_LOG_DEBUG_NAMED("races", "debug %f", (double)turn);
  RCUTILS_LOG_INFO_NAMED("races", "info %ls", wide);
  RCUTILS_LOG_WARN_NAMED("races", "warn %u", (unsigned)turn);
  RCUTILS_LOG_ERROR_NAMED("races", "error %u", (unsigned)turn);
  DO(rcutils_logging_set_logger_level(
    "races", turn % 2u == 0u ? RCUTILS_LOG_SEVERITY_DEBUG : RCUTILS_LOG_SEVERITY_WARN));
  TRUE(rcutils_logging_get_logger_effective_level("races") != 0);
  TRUE(rcl_get_error_string().str[0] != '\1');
  rcl_reset_error();
#ifdef RACES_DIAGNOSIS
  {
    rclc_diagnosis_callback_t times;

    DO(rclc_diagnosis_set((uint8_t)DIAGNOSIS_BATTERY, (int32_t)(turn % 2u) * 12000));
    TRUE(rclc_diagnosis_level((uint8_t)DIAGNOSIS_BATTERY) <= RCLC_DIAGNOSIS_STALE);
    DO(rclc_diagnosis_get_callback((uint8_t)RCLC_CALLBACK_BEAT, &times));
  }
#endif
#ifdef RACES_TASKS
  {
    rclc_task_counters_t counters;

    DO(rclc_task_get_counters((uint8_t)(turn % 3u), &counters));
    TRUE(rclc_task_stack_peak((uint8_t)(turn % 3u)) <= rclc_task_stack_size((uint8_t)(turn % 3u)));
    DO(rclc_task_set_priority((uint8_t)RCLC_TASK_CONTROL, (uint8_t)(1u + turn % 2u)));
    (void)rclc_tasks_are_prioritized();
  }
#endif
  TRUE(rmw_uros_get_refused_memory() == 0u);
#ifdef RACES_ON_SILENCE
  TRUE(rmw_uros_silences() > 0u);
#endif
}

/* Asks the agent, and for times. */
static void ask_once(uint32_t turn)
{
  rmw_context_t * const context = rcl_context_get_rmw_context(&support.context);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  int64_t due;

  (void)allocator;
  TRUE(rmw_uros_is_connected(context));
  DO(rmw_uros_time_until_due(context, &due));
  DO(rmw_uros_spin_once(context));
#ifdef RACES_PING
  if (turn % 8u == 0u) {
    DO(rmw_uros_ping_agent(100, 1));
  }
#endif
#ifdef RACES_AGENTS
  {
    rmw_uros_agent_t agent;
    DO(rmw_uros_get_agent(context, &agent));
  }
#endif
#ifdef RACES_TIME_SYNC
  if (turn % 8u == 4u) {
    DO(rmw_uros_sync_session(100));
  }
  TRUE(rmw_uros_epoch_synchronized());
  TRUE(rmw_uros_epoch_nanos() > 0);
#endif
#ifdef RACES_TIME_SOURCE
  {
    rmw_uros_time_status_t status;
    DO(rmw_uros_time_source_status(&status));
  }
#endif
#ifdef RACES_GRAPH
  if (turn % 4u == 0u) {
    rcutils_string_array_t names = rcutils_get_zero_initialized_string_array();
    rcutils_string_array_t spaces = rcutils_get_zero_initialized_string_array();
    size_t found;

    DO(rcl_count_publishers(&node, "/target", &found));
    if (count("rcl_get_node_names", rcl_get_node_names(&node, allocator, &names, &spaces) == RCL_RET_OK)) {
      (void)rcutils_string_array_fini(&names);
      (void)rcutils_string_array_fini(&spaces);
    }
  }
#endif
  if (turn % 32u == 0u) {
    DO(rmw_uros_flush(context, 200)); /* until nothing of any task is on its way */
  }
}

static rcl_guard_condition_t guard;
static uint32_t news; /* with the library's lock, as the callback is called */

static void on_news(const void * user_data, size_t number)
{
  (void)user_data;
  news += (uint32_t)number;
}

/* Waits with its own wait set, and takes. */
static void wait_once(rcl_wait_set_t * set, uint32_t turn)
{
  static char room[21];
  static std_msgs__msg__String text = {{room, 0, sizeof(room)}};

  (void)turn;
  DO(rcl_wait_set_clear(set));
  DO(rcl_wait_set_add_guard_condition(set, &guard, NULL));
  DO(rcl_wait_set_add_subscription(set, &SUBSCRIPTION_plain, NULL));
  TRUE(rcl_wait(set, RCL_MS_TO_NS(5)) == RCL_RET_OK);
  if (set->subscriptions[0] != NULL) {
#ifdef RACES_LOANED_MESSAGES
    void * loan = NULL;

    if (count(
          "rcl_take_loaned_message",
          rcl_take_loaned_message(&SUBSCRIPTION_plain, &loan, NULL, NULL) == RCL_RET_OK)) {
      TRUE(((const std_msgs__msg__String *)loan)->data.size < 20u);
      DO(rcl_return_loaned_message_from_subscription(&SUBSCRIPTION_plain, loan));
    }
#else
    DO(rcl_take(&SUBSCRIPTION_plain, &text, NULL, NULL));
#endif
  }
  (void)text;
#ifdef RACES_ACTION_CLIENT
  {
    static test_msgs__action__Fibonacci_SendGoal_Request goal = {.goal = {.order = 2}};
    rclc_action_goal_handle_t * handle = NULL;

    if (count(
          "rclc_action_send_goal_request",
          rclc_action_send_goal_request(&action_client_0, &goal, &handle) == RCL_RET_OK)) {
      port_sleep_ms(5);
      TRUE(rclc_action_send_cancel_request(handle) == RCL_RET_OK);
    }
  }
#endif
}

#ifdef RACES_PARAMETER_CLIENT
static void on_values(rclc_parameter_client_t * client, rcl_ret_t result, void * context)
{
  rclc_parameter_client_value_t value;

  (void)context;
  if (count("values of /motor", result == RCL_RET_OK)) {
    DO(rclc_parameter_client_value(client, 0, &value));
  }
}
#endif

/* What belongs to the task of the first executor: called at its releases, after its callbacks. */
static void on_release_too(uint8_t task)
{
  static uint32_t turn;
  rcl_time_point_value_t now;

  on_release(task);
  ++turn;
  DO(rcl_clock_get_now(&support.clock, &now));
#ifdef RACES_CLOCK_STAMP
  {
    int32_t seconds;
    uint32_t nanoseconds;
    DO(rclc_stamp(&support.clock, &seconds, &nanoseconds));
  }
#endif
#ifdef RACES_PARAMETERS
  {
    double speed;
    DO(rclc_parameter_set_bool(&node_parameters, "on", turn % 2u == 0u));
    DO(rclc_parameter_get_double(&node_parameters, "speed", &speed));
  }
#endif
#ifdef RACES_PARAMETER_STORAGE
  if (turn % 32u == 0u) {
    size_t skipped;
    DO(rclc_parameter_storage_save(&node_parameters, 0));
    DO(rclc_parameter_storage_load(&node_parameters, 0, &skipped));
  }
#endif
#ifdef RACES_NODE_MODES
  if (turn % 16u == 8u) {
    DO(rclc_modes_change(&own_node_modes, turn % 32u == 8u ? own_mode_SLOW : own_mode_FAST));
  }
#endif
#ifdef RACES_LIFECYCLE
  if (turn % 16u == 1u) {
    const bool is_active = node_states.current_state->id == lifecycle_msgs__msg__State__PRIMARY_STATE_ACTIVE;
    DO(rclc_lifecycle_change_state(
      &node_lifecycle,
      turn == 1u  ? lifecycle_msgs__msg__Transition__TRANSITION_CONFIGURE
      : is_active ? lifecycle_msgs__msg__Transition__TRANSITION_DEACTIVATE
                  : lifecycle_msgs__msg__Transition__TRANSITION_ACTIVATE,
      true));
  }
#endif
#ifdef RACES_PARAMETER_CLIENT
  {
    static const char * const names[] = {"speed"};
    TRUE(rclc_parameter_client_get_async(&parameters_of_0, names, 1, 500, on_values, NULL) == RCL_RET_OK);
  }
#endif
#ifdef RACES_EXECUTOR_NODES
  {
    rclc_executor_node_info_t info;
    DO(rclc_executor_query_node(&executor_0, &node, &info));
  }
#endif
#ifdef RACES_SERVICE_CALL
  if (turn % 8u == 3u) {
    static const example_interfaces__srv__AddTwoInts_Request request = {.a = 1, .b = 2};
    example_interfaces__srv__AddTwoInts_Response response;
    DO(rclc_executor_call_service(&executor_0, &CLIENT_ros_sum, &request, &response, RCL_MS_TO_NS(300)));
  }
#endif
}

static void * run(void * argument)
{
  const size_t self = *(const size_t *)argument;
  rcl_wait_set_t set = rcl_get_zero_initialized_wait_set();
  uint32_t turn = 0;

  if (self == 3u) {
    DO(rcl_wait_set_init(&set, 1, 1, 0, 0, 0, 0, &support.context, rcl_get_default_allocator()));
  }
  while (!has_ended()) {
    switch (self) {
      case 0:
        write_once(turn);
        break;
      case 1:
        log_once(turn);
        break;
      case 2:
        ask_once(turn);
        DO(rcl_trigger_guard_condition(&guard));
        break;
      default:
        wait_once(&set, turn);
        break;
    }
    ++turn;
    port_sleep_ms(2);
  }
  if (self == 3u) {
    DO(rcl_wait_set_fini(&set));
  }
  return NULL;
}

#ifdef RACES_SESSION_STATE
static void on_session(const rmw_uros_session_event_t * event, void * argument)
{
  (void)argument;
  TRUE(event->state == RMW_UROS_SESSION_CONNECTED);
}
#endif

static pthread_t threads[THREADS];
static size_t started;

/* In place of rclc_tasks_start: all entities are open. */
static rcl_ret_t races_start(void)
{
  static size_t selves[THREADS];
  rcl_ret_t result;

  open_more();
  guard = rcl_get_zero_initialized_guard_condition();
  DO(rcl_guard_condition_init(&guard, &support.context, rcl_guard_condition_get_default_options()));
  DO(rclc_executor_remove_subscription(&executor_1, &SUBSCRIPTION_plain));
#ifdef RACES_SERVICE_CALL
  DO(rclc_executor_remove_client(&executor_1, &CLIENT_ros_sum));
#endif
#ifdef RACES_NEW_DATA_CALLBACKS
  DO(rcl_subscription_set_on_new_message_callback(&SUBSCRIPTION_plain, on_news, NULL));
#endif
#ifdef RACES_SESSION_STATE
  DO(rmw_uros_set_session_callback(on_session, NULL));
#endif
  DO(rclc_task_set_executor((uint8_t)RCLC_TASK_CONTROL, &executor_0, on_release_too));
  result = (rclc_tasks_start)();
  for (size_t i = 0; i < THREADS && result == RCL_RET_OK; ++i) {
    selves[i] = i;
    result = pthread_create(&threads[i], NULL, run, &selves[i]) == 0 ? RCL_RET_OK : RCL_RET_ERROR;
    started += result == RCL_RET_OK ? 1u : 0u;
  }
  (void)fprintf(stderr, "started\n");
  return result;
}

/* In place of rclc_tasks_stop. */
static rcl_ret_t races_stop(void)
{
  rcl_ret_t result;

  end();
  for (size_t i = 0; i < started; ++i) {
    (void)pthread_join(threads[i], NULL);
  }
  result = (rclc_tasks_stop)();
  DO(rcl_guard_condition_fini(&guard));
  close_more();
  return result;
}

int main(void)
{
  (void)example_main(); /* its result counts what could not be sent while the agent was away */
  TRUE(news > 0u);
  for (size_t i = 0; i < NAMES && outcomes[i].name != NULL; ++i) {
    (void)fprintf(
      stderr, "%u/%u %s: %s\n", (unsigned)outcomes[i].succeeded, (unsigned)outcomes[i].called,
      outcomes[i].name, outcomes[i].error);
  }
  return started == THREADS ? 0 : 1;
}
