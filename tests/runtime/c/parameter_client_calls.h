/* SPDX-License-Identifier: Apache-2.0 */
/* Calls of a client of parameters as the test requests them, one in a line; the results are printed. */
#ifndef PARAMETER_CLIENT_CALLS_H
#define PARAMETER_CLIENT_CALLS_H

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_parameter/parameter_client.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS_MAX = 80 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_parameter_client_t client;
static rclc_executor_t executor;
static rcl_allocator_t allocator;
static uint32_t timeout_ms = 500;
static bool waits_inside; /* a callback makes a call that waits */

/* Words of a line; the line is changed. */
typedef struct words_t {
  const char * word[WORDS_MAX];
  size_t count;
} words_t;

static words_t split(char * line)
{
  words_t words = {{NULL}, 0};

  for (char * word = strtok(line, " "); word != NULL && words.count < WORDS_MAX; word = strtok(NULL, " ")) {
    words.word[words.count] = word;
    ++words.count;
  }
  return words;
}

static void print_text(const char * text)
{
  printf(" '");
  for (; *text != '\0'; ++text) {
    printf("%c", *text >= ' ' && *text <= '~' ? *text : '?');
  }
  printf("'");
}

static void print_value(const rclc_parameter_client_value_t * value)
{
  printf(" %d", (int)value->type);
  switch (value->type) {
    case RCLC_PARAMETER_BOOL:
      printf(" %d", value->as.bool_value ? 1 : 0);
      break;
    case RCLC_PARAMETER_INT:
      printf(" %" PRId64, value->as.integer_value);
      break;
    case RCLC_PARAMETER_DOUBLE:
      printf(" %g", value->as.double_value);
      break;
    case RCLC_PARAMETER_STRING:
      print_text(value->as.string_value);
      break;
    default:
      break;
  }
  for (size_t i = 0; i < value->count; ++i) {
    if (value->type == RCLC_PARAMETER_BYTE_ARRAY) {
      printf(" %d", value->as.byte_array_value[i]);
    } else if (value->type == RCLC_PARAMETER_BOOL_ARRAY) {
      printf(" %d", value->as.bool_array_value[i] ? 1 : 0);
    } else if (value->type == RCLC_PARAMETER_INT_ARRAY) {
      printf(" %" PRId64, value->as.integer_array_value[i]);
    } else if (value->type == RCLC_PARAMETER_DOUBLE_ARRAY) {
      printf(" %g", value->as.double_array_value[i]);
    } else {
      print_text(value->as.string_array_value[i]);
    }
  }
  printf("\n");
}

static void print_descriptor(const rclc_parameter_client_descriptor_t * descriptor)
{
  printf("descriptor");
  print_text(descriptor->name);
  printf(" %d", (int)descriptor->type);
  print_text(descriptor->description);
  print_text(descriptor->additional_constraints);
  printf(" %d %d", descriptor->read_only ? 1 : 0, descriptor->dynamic_typing ? 1 : 0);
  if (descriptor->has_integer_range) {
    printf(
      " %" PRId64 "..%" PRId64 " by %" PRIu64, descriptor->integer_range.from_value,
      descriptor->integer_range.to_value, descriptor->integer_range.step);
  }
  if (descriptor->has_floating_point_range) {
    printf(
      " %g..%g by %g", descriptor->floating_point_range.from_value, descriptor->floating_point_range.to_value,
      descriptor->floating_point_range.step);
  }
  printf("\n");
}

/* Prints item `index` of descriptors or types; false: the call was another one. */
static bool print_described(size_t index)
{
  rclc_parameter_client_descriptor_t descriptor;
  rclc_parameter_type_t type;
  rcl_ret_t result = rclc_parameter_client_descriptor(&client, index, &descriptor);

  if (result == RCL_RET_OK) {
    print_descriptor(&descriptor);
    return true;
  }
  result = rclc_parameter_client_type(&client, index, &type);
  if (result == RCL_RET_OK) {
    printf("type %d\n", (int)type);
  } else if (result != RCL_RET_INVALID_ARGUMENT) {
    printf("no type %d\n", (int)result);
  }
  return result != RCL_RET_INVALID_ARGUMENT;
}

/* Prints what the last call got. */
static void print_response(void)
{
  for (size_t i = 0; i < rclc_parameter_client_count(&client); ++i) {
    const char * reason = NULL;
    const char * name = rclc_parameter_client_name(&client, i);
    rclc_parameter_client_value_t value;
    rcl_ret_t result = rclc_parameter_client_outcome(&client, i, &reason);

    if (name != NULL) {
      printf("name");
      print_text(name);
      printf("\n");
    } else if (reason != NULL) {
      printf("outcome %d", (int)result);
      print_text(reason);
      printf("\n");
    } else {
      result = rclc_parameter_client_value(&client, i, &value);
      if (result == RCL_RET_OK) {
        printf("value");
        print_value(&value);
      } else if (result != RCL_RET_INVALID_ARGUMENT || !print_described(i)) {
        printf("no value %d\n", (int)result);
      }
    }
  }
}

static void on_result(struct rclc_parameter_client_t * of, rcl_ret_t result, void * context)
{
  if (of != &client || context != &timeout_ms) {
    abort();
  }
  printf("done %d", (int)result);
  print_text(result == RCL_RET_OK ? "" : rcl_get_error_string().str);
  printf("\n");
  print_response();
  if (waits_inside) {
    int64_t value;

    result = rclc_parameter_client_get_int(&client, "inside", &value, timeout_ms);
    printf("inside %d", (int)result);
    print_text(rcl_get_error_string().str);
    printf("\n");
  }
}

static void on_event(
  struct rclc_parameter_client_t * of, rclc_parameter_client_change_t change, const char * name,
  const rclc_parameter_client_value_t * value, void * context)
{
  static const char * const words[] = {"new", "changed", "deleted", "missed"};
  int64_t number;

  if (of != &client || context != &executor) {
    abort();
  }
  printf("event %s %s", words[change], name); /* no test damages the name of an event's parameter */
  if (value != NULL) {
    print_value(value);
  } else {
    printf("\n");
  }
  if (waits_inside) {
    printf("inside %d\n", (int)rclc_parameter_client_get_int(&client, "inside", &number, timeout_ms));
  }
}

static rcl_ret_t open_client(void)
{
  rcl_ret_t result = rclc_parameter_client_init_default(&client, &node, "/motor");

  if (result == RCL_RET_OK) {
    result = rclc_executor_init(&executor, &support.context, 1, &allocator);
  }
  return result == RCL_RET_OK ? rclc_executor_add_parameter_client(&executor, &client) : result;
}

static rcl_ret_t close_client(void)
{
  rcl_ret_t result = rclc_executor_remove_parameter_client(&executor, &client);

  if (result == RCL_RET_OK) {
    result = rclc_parameter_client_fini(&client, &node);
  }
  return result == RCL_RET_OK ? rclc_executor_fini(&executor) : result;
}

static rcl_ret_t open_all(void)
{
  rcl_ret_t result;

  allocator = rcl_get_default_allocator();
  result = rclc_support_init(&support, 0, NULL, &allocator);
  if (result == RCL_RET_OK) {
    result = rclc_node_init_default(&node, "device", "arm", &support);
  }
  return result == RCL_RET_OK ? open_client() : result;
}

/* Arrays of the values of a line. */
static uint8_t bytes[WORDS_MAX];
static bool truths[WORDS_MAX];
static int64_t integers[WORDS_MAX];
static double doubles[WORDS_MAX];
static const char * texts[WORDS_MAX];
static size_t texts_capacity = WORDS_MAX;

static void read_numbers(const words_t * words, size_t first)
{
  for (size_t i = first; i < words->count; ++i) {
    integers[i - first] = strtoll(words->word[i], NULL, 10);
    doubles[i - first] = strtod(words->word[i], NULL);
    bytes[i - first] = (uint8_t)integers[i - first];
    truths[i - first] = integers[i - first] != 0;
  }
}

/* set TYPE NAME VALUE…, by the function of the type */
static rcl_ret_t set_one(const words_t * words)
{
  const char * name = words->word[2];
  const size_t count = words->count - 3u;

  read_numbers(words, 3u);
  switch (atoi(words->word[1])) {
    case RCLC_PARAMETER_BOOL:
      return rclc_parameter_client_set_bool(&client, name, truths[0], timeout_ms);
    case RCLC_PARAMETER_INT:
      return rclc_parameter_client_set_int(&client, name, integers[0], timeout_ms);
    case RCLC_PARAMETER_DOUBLE:
      return rclc_parameter_client_set_double(&client, name, doubles[0], timeout_ms);
    case RCLC_PARAMETER_STRING:
      return rclc_parameter_client_set_string(&client, name, count > 0u ? words->word[3] : "", timeout_ms);
    case RCLC_PARAMETER_BYTE_ARRAY:
      return rclc_parameter_client_set_byte_array(&client, name, bytes, count, timeout_ms);
    case RCLC_PARAMETER_BOOL_ARRAY:
      return rclc_parameter_client_set_bool_array(&client, name, truths, count, timeout_ms);
    case RCLC_PARAMETER_INT_ARRAY:
      return rclc_parameter_client_set_int_array(&client, name, integers, count, timeout_ms);
    case RCLC_PARAMETER_DOUBLE_ARRAY:
      return rclc_parameter_client_set_double_array(&client, name, doubles, count, timeout_ms);
    default:
      return rclc_parameter_client_set_string_array(&client, name, &words->word[3], count, timeout_ms);
  }
}

/* get TYPE NAME, by the function of the type */
static rcl_ret_t get_one(const words_t * words)
{
  rclc_parameter_client_value_t value = {(rclc_parameter_type_t)atoi(words->word[1]), 0, {false}};
  const char * name = words->word[2];
  rcl_ret_t result;

  switch (value.type) {
    case RCLC_PARAMETER_BOOL:
      result = rclc_parameter_client_get_bool(&client, name, &value.as.bool_value, timeout_ms);
      break;
    case RCLC_PARAMETER_INT:
      result = rclc_parameter_client_get_int(&client, name, &value.as.integer_value, timeout_ms);
      break;
    case RCLC_PARAMETER_DOUBLE:
      result = rclc_parameter_client_get_double(&client, name, &value.as.double_value, timeout_ms);
      break;
    case RCLC_PARAMETER_STRING:
      result = rclc_parameter_client_get_string(&client, name, &value.as.string_value, timeout_ms);
      break;
    case RCLC_PARAMETER_BYTE_ARRAY:
      result = rclc_parameter_client_get_byte_array(
        &client, name, &value.as.byte_array_value, &value.count, timeout_ms);
      break;
    case RCLC_PARAMETER_BOOL_ARRAY:
      result = rclc_parameter_client_get_bool_array(
        &client, name, &value.as.bool_array_value, &value.count, timeout_ms);
      break;
    case RCLC_PARAMETER_INT_ARRAY:
      result = rclc_parameter_client_get_int_array(
        &client, name, &value.as.integer_array_value, &value.count, timeout_ms);
      break;
    case RCLC_PARAMETER_DOUBLE_ARRAY:
      result = rclc_parameter_client_get_double_array(
        &client, name, &value.as.double_array_value, &value.count, timeout_ms);
      break;
    default:
      value.as.string_array_value = texts;
      result = rclc_parameter_client_get_string_array(
        &client, name, texts, texts_capacity, &value.count, timeout_ms);
      break;
  }
  if (result == RCL_RET_OK) {
    printf("value");
    print_value(&value);
  }
  return result;
}

/* several CALL NAME=INTEGER…; a name alone deletes */
static rcl_ret_t set_several(words_t * words, bool is_async)
{
  rclc_parameter_client_parameter_t parameters[WORDS_MAX];
  const size_t count = words->count - 2u;

  for (size_t i = 0; i < count; ++i) {
    char * equals = strchr(words->word[i + 2u], '=');

    parameters[i].name = words->word[i + 2u];
    parameters[i].value.type = equals != NULL ? RCLC_PARAMETER_INT : RCLC_PARAMETER_NOT_SET;
    parameters[i].value.count = 0;
    parameters[i].value.as.integer_value = equals != NULL ? atoi(&equals[1]) : 0;
    if (equals != NULL) {
      *equals = '\0';
    }
  }
  if (strcmp(words->word[1], "each") == 0) {
    return is_async
             ? rclc_parameter_client_set_async(&client, parameters, count, timeout_ms, on_result, &timeout_ms)
             : rclc_parameter_client_set(&client, parameters, count, timeout_ms);
  }
  return is_async ? rclc_parameter_client_set_atomically_async(
                      &client, parameters, count, timeout_ms, on_result, &timeout_ms)
                  : rclc_parameter_client_set_atomically(&client, parameters, count, timeout_ms);
}

static rcl_ret_t names(const words_t * words)
{
  const char * const * first = &words->word[1];
  const size_t count = words->count - 1u;
  rcl_ret_t result;

  if (strcmp(words->word[0], "async_names") == 0) {
    return rclc_parameter_client_get_async(&client, first, count, timeout_ms, on_result, &timeout_ms);
  }
  if (strcmp(words->word[0], "async_list") == 0) {
    return rclc_parameter_client_list_async(&client, first, count, 0, timeout_ms, on_result, &timeout_ms);
  }
  result = strcmp(words->word[0], "list") == 0
             ? rclc_parameter_client_list(&client, first, count, 0, timeout_ms)
             : rclc_parameter_client_get(&client, first, count, timeout_ms);
  if (result == RCL_RET_OK) {
    print_response();
  }
  return result;
}

/* What a node says of names: describe, types, and the same with async_ */
static rcl_ret_t describe_names(const words_t * words)
{
  const char * const * first = &words->word[1];
  const size_t count = words->count - 1u;
  rcl_ret_t result;

  if (strcmp(words->word[0], "async_describe") == 0) {
    return rclc_parameter_client_describe_async(&client, first, count, timeout_ms, on_result, &timeout_ms);
  }
  if (strcmp(words->word[0], "async_types") == 0) {
    return rclc_parameter_client_get_types_async(&client, first, count, timeout_ms, on_result, &timeout_ms);
  }
  result = strcmp(words->word[0], "describe") == 0
             ? rclc_parameter_client_describe(&client, first, count, timeout_ms)
             : rclc_parameter_client_get_types(&client, first, count, timeout_ms);
  if (result == RCL_RET_OK) {
    print_response();
  }
  return result;
}

/* get_type NAME, get_descriptor NAME */
static rcl_ret_t describe_one(const words_t * words)
{
  rclc_parameter_client_descriptor_t descriptor;
  rclc_parameter_type_t type;
  rcl_ret_t result;

  if (strcmp(words->word[0], "get_type") == 0) {
    result = rclc_parameter_client_get_type(&client, words->word[1], &type, timeout_ms);
    if (result == RCL_RET_OK) {
      printf("type %d\n", (int)type);
    }
    return result;
  }
  result = rclc_parameter_client_get_descriptor(&client, words->word[1], &descriptor, timeout_ms);
  if (result == RCL_RET_OK) {
    print_descriptor(&descriptor);
  }
  return result;
}

static rcl_ret_t call_words(words_t * words)
{
  const char * word = words->word[0];
  rcl_ret_t result;

  if (strcmp(word, "init") == 0) {
    return open_all();
  }
  if (strcmp(word, "close") == 0) {
    return close_client();
  }
  if (strcmp(word, "open") == 0) {
    return open_client();
  }
  if (strcmp(word, "stranger") == 0) {
    static rclc_parameter_client_t stranger;

    return rclc_parameter_client_init_default(&stranger, &node, "/stranger");
  }
  if (strcmp(word, "timeout") == 0) {
    timeout_ms = (uint32_t)strtoul(words->word[1], NULL, 10);
    return RCL_RET_OK;
  }
  if (strcmp(word, "capacity") == 0) {
    texts_capacity = strtoul(words->word[1], NULL, 10);
    return RCL_RET_OK;
  }
  if (strcmp(word, "inside") == 0) {
    waits_inside = true;
    return RCL_RET_OK;
  }
  if (strcmp(word, "watch") == 0) {
    return rclc_parameter_client_watch(&client, on_event, &executor);
  }
  if (strcmp(word, "unwatch") == 0) {
    return rclc_parameter_client_watch(&client, NULL, NULL);
  }
  if (strcmp(word, "spin") == 0) {
    result = rclc_executor_spin_some(&executor, strtoull(words->word[1], NULL, 10) * 1000000u);
    return result == RCL_RET_TIMEOUT ? RCL_RET_OK : result;
  }
  if (strcmp(word, "get") == 0) {
    return get_one(words);
  }
  if (strcmp(word, "set") == 0) {
    return set_one(words);
  }
  if (strcmp(word, "get_type") == 0 || strcmp(word, "get_descriptor") == 0) {
    return describe_one(words);
  }
  if (strstr(word, "describe") != NULL || strstr(word, "types") != NULL) {
    return describe_names(words);
  }
  if (strcmp(word, "several") == 0) {
    result = set_several(words, false);
    print_response();
    return result;
  }
  return strcmp(word, "async_several") == 0 ? set_several(words, true) : names(words);
}

static void calls_run(char * line)
{
  words_t words = split(line);
  rcl_ret_t result;

  rcl_reset_error();
  result = call_words(&words);
  printf("ret %d %s\n", (int)result, result == RCL_RET_OK ? "" : rcl_get_error_string().str);
  fflush(stdout);
}

#endif /* PARAMETER_CLIENT_CALLS_H */
