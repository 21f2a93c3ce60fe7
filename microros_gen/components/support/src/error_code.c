/* SPDX-License-Identifier: Apache-2.0 */
/* errors: code. Numbers stand for the texts. */
#include "microros/error.h"
#include "microros/error_state.h"

#include <stddef.h>
#include <string.h>

const char microros_error_argument[] = "E02";
const char microros_error_context_in_use[] = "E03";
const char microros_error_transport[] = "E04";
const char microros_error_agent_silent[] = "E05";
const char microros_error_agent_refused[] = "E06";
const char microros_error_address[] = "E07";
const char microros_error_name[] = "E08";
const char microros_error_name_long[] = "E09";
const char microros_error_node_undeclared[] = "E10";
const char microros_error_node_open[] = "E11";
const char microros_error_nodes_full[] = "E12";
const char microros_error_publisher_undeclared[] = "E13";
const char microros_error_publisher_open[] = "E14";
const char microros_error_publishers_full[] = "E15";
const char microros_error_stream_small[] = "E16";
const char microros_error_qos[] = "E17";
const char microros_error_entity_silent[] = "E18";
const char microros_error_entity_refused[] = "E19";
const char microros_error_field[] = "E20";
const char microros_error_stream_full[] = "E21";
const char microros_error_no_session[] = "E22";
const char microros_error_not_sent[] = "E23";
const char microros_error_arena[] = "E24";
const char microros_error_serialized[] = "E25";
const char microros_error_domain[] = "E26";
const char microros_error_device[] = "E27";
const char microros_error_custom_unset[] = "E28";
const char microros_error_framing[] = "E29";

enum { CODE_SIZE = sizeof("E00") };

static void error_write(const char * error, const char * file, size_t line_number)
{
  rcutils_error_state_t * state = microros_error_state();

  memcpy(state->message, error, CODE_SIZE);
  state->file = file;
  state->line_number = line_number;
}

void microros_error_set(
  const char * error, const char * name, const char * detail, uint32_t found, uint32_t fits)
{
  (void)name;
  (void)detail;
  (void)found;
  (void)fits;
  error_write(error, NULL, 0);
}

void rcutils_set_error_state(const char * error_string, const char * file, size_t line_number)
{
  (void)error_string;
  error_write("E01", file, line_number);
}
