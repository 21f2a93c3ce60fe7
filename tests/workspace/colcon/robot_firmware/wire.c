/* SPDX-License-Identifier: Apache-2.0 */
/* Writes a message to stdout: CDR without its header. */
#include <robot_interfaces/msg/robot.h>

#include <microros/message_type.h>

#include <stdio.h>
#include <stdlib.h>

int main(void)
{
  static uint8_t body[4096];
  static robot_interfaces__msg__Robot robot;
  const rosidl_message_type_support_t * support = ROSIDL_GET_MSG_TYPE_SUPPORT(robot_interfaces, msg, Robot);
  const microros_message_type_t * type = support->data;
  cdr_fault_t fault;

  if (type->max_encoded_size > sizeof(body) || !robot_interfaces__msg__Robot__init(&robot)) {
    return EXIT_FAILURE;
  }
  robot.wheels[1].speed = 6.25f;
  robot.stamp.sec = 7;
  const uint32_t size = type->encode(&robot, body, &fault);
  return size != 0u && fwrite(body, 1, size, stdout) == size ? EXIT_SUCCESS : EXIT_FAILURE;
}
