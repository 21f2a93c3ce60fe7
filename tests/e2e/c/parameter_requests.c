/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A parameter server without an agent: reads "SERVICE BYTES" (hexadecimal CDR, "big" in front of big endian), lets it
 * answer, and prints the reply, or "refused".
 */
#include <microros/cdr_decode.h>
#include <microros/rclc_parameters.h>
#include <microros/service_type.h>
#ifdef REQUESTS_DECLARED
#include <rclc_parameter/declared_parameters.h>
#endif

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_MAX = 8192, BODY_MAX = 4096 };

static rclc_parameter_server_t server;

static bool accepts(const Parameter * old_param, const Parameter * new_param, void * context)
{
  (void)context;
  /* Every string that the callback gets ends with a NUL, and its size says where. */
  if (old_param != NULL && strlen(old_param->name.data) != old_param->name.size) {
    abort();
  }
  if (new_param != NULL && strlen(new_param->name.data) != new_param->name.size) {
    abort();
  }
  return new_param == NULL || new_param->value.type != RCLC_PARAMETER_INT ||
         new_param->value.integer_value != 66;
}

static const microros_service_type_t * service_of(const char * name)
{
  static const struct {
    const char * name;
    const rosidl_service_type_support_t * type;
  } services[] = {
    {"get_parameters", &rclc_parameter_get_type},   {"get_parameter_types", &rclc_parameter_get_types_type},
    {"set_parameters", &rclc_parameter_set_type},   {"set_parameters_atomically", &rclc_parameter_set_atomically_type},
    {"list_parameters", &rclc_parameter_list_type}, {"describe_parameters", &rclc_parameter_describe_type},
  };

  for (size_t i = 0; i < sizeof(services) / sizeof(services[0]); ++i) {
    if (strcmp(services[i].name, name) == 0) {
      return services[i].type->data;
    }
  }
  abort();
}

static uint32_t read_bytes(const char * text, uint8_t * bytes)
{
  uint32_t size = 0;
  unsigned int byte;

  while (sscanf(&text[2u * size], "%2x", &byte) == 1) {
    bytes[size] = (uint8_t)byte;
    ++size;
  }
  return size;
}

static void show(const uint8_t * body, uint32_t size)
{
  (void)printf("=");
  for (uint32_t i = 0; i < size; ++i) {
    (void)printf("%02x", body[i]);
  }
  (void)printf("\n");
}

/* The body has exactly the room that is promised: a sanitizer sees what goes beyond it. */
static void answer(const microros_service_type_t * service, const uint8_t * request, uint32_t size, bool swap)
{
  uint8_t * body = malloc(service->response->max_encoded_size);
  uint8_t * copy = malloc(size == 0u ? 1u : size);
  cdr_fault_t fault;

  if (body == NULL || copy == NULL) {
    abort();
  }
  (void)memcpy(copy, request, size);
  if (!cdr_decode(service->request, copy, size, swap, &server, &fault)) {
    (void)printf("refused\n");
  } else {
    if (service->request->decode == rclc_parameter_decode_parameters) {
      if (service == service_of("set_parameters")) {
        rclc_parameter_set_each(&server);
      } else {
        rclc_parameter_set_all(&server);
      }
    }
    show(body, service->response->encode(&server, body, &fault));
  }
  free(copy);
  free(body);
}

static void check(rcl_ret_t result)
{
  if (result != RCL_RET_OK) {
    abort();
  }
}

/* The compiler's division is the model. */
static void check_division(void)
{
  static const uint64_t numbers[] = {
    1, 2, 3, 999999999, 1000000000, 1763877000123456789u, INT64_MAX, (uint64_t)INT64_MAX + 1u, UINT64_MAX, 0};

  for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); ++i) {
    for (size_t k = 0; numbers[k] != 0u; ++k) {
      uint64_t rest;

      if (
        rclc_parameter_divide(numbers[i], numbers[k], &rest) != numbers[i] / numbers[k] ||
        rest != numbers[i] % numbers[k]) {
        abort();
      }
    }
  }
}

static void add_parameters(void)
{
#ifdef REQUESTS_DECLARED
  check(arm_device_parameters_declare(&server));
#else
  check(rclc_add_parameter(&server, "a", RCLC_PARAMETER_BOOL));
  check(rclc_add_parameter(&server, "b.steps", RCLC_PARAMETER_INT));
  check(rclc_add_parameter(&server, "b.gain", RCLC_PARAMETER_DOUBLE));
#endif
}

/* Arguments: "undeclared" lets set requests create parameters. */
int main(int argc, char ** argv)
{
  static char line[LINE_MAX];
  static uint8_t request[BODY_MAX];

  check_division();
  server.max_params = MICROROS_PARAMETERS_MAX;
  server.on_modification = accepts;
  server.undeclared = argc > 1 && strcmp(argv[1], "undeclared") == 0 ? &rclc_parameter_undeclared : NULL;
  add_parameters();
  while (fgets(line, sizeof(line), stdin) != NULL) {
    char * space = strchr(line, ' ');
    const bool swap = space != NULL && strncmp(&space[1], "big", 3u) == 0;

    if (space == NULL) {
      abort();
    }
    *space = '\0';
    answer(service_of(line), request, read_bytes(swap ? &space[4] : &space[1], request), swap);
    (void)fflush(stdout);
  }
  return 0;
}
