/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Broadcasts transforms until its standard input ends. Lines: "move CHILD NUMBER" sends one from `odom` on /tf, "pair NUMBER"
 * two in one message, "fix CHILD NUMBER" one from `base` on /tf_static, "fixed CHILD OTHER" two, "many" more than a message
 * has room for, "none", "null" and "frames" wrong arguments, and "again" opens the static broadcaster once more. Each is
 * answered with what was returned. `-` is an empty name.
 */
#define _POSIX_C_SOURCE 200809L
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rcl/error_handling.h>
#include <rcl/rcl.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <rclc_tf/rclc_tf.h>

#include "commanded.h"

enum { MOST = 4, NAME = 64 };

static rclc_support_t support;
static rcl_node_t node;
static rclc_executor_t executor;
static rclc_tf_broadcaster_t moving;
static rclc_static_tf_broadcaster_t fixed;
static char names[MOST][NAME];
static geometry_msgs__msg__TransformStamped transforms[MOST];

static void fill(size_t index, char * parent, const char * child, double x)
{
  geometry_msgs__msg__TransformStamped * transform = &transforms[index];

  (void)memset(transform, 0, sizeof(*transform));
  (void)snprintf(names[index], NAME, "%s", strcmp(child, "-") == 0 ? "" : child);
  check(rclc_tf_set_frames(transform, parent, names[index]), "frames");
  transform->header.stamp.sec = 7;
  transform->header.stamp.nanosec = 500u;
  transform->transform.translation.x = x;
  transform->transform.rotation.w = 1.0;
}

static rcl_ret_t refuse(const char * word)
{
  static char name[] = "wheel";
  rclc_static_tf_broadcaster_t none;

  (void)memset(&none, 0, sizeof(none));
  if (strcmp(word, "none") == 0) {
    return rclc_tf_broadcaster_send(&moving, transforms, 0);
  }
  if (strcmp(word, "null") == 0) {
    return rclc_static_tf_broadcaster_send(&none, transforms, 1);
  }
  if (strcmp(word, "frames") == 0) {
    return rclc_tf_set_frames(&transforms[0], name, NULL);
  }
  check(rclc_static_tf_broadcaster_fini(&fixed, &node), "fini");
  return rclc_static_tf_broadcaster_init(&fixed, &node);
}

static rcl_ret_t run(char ** word)
{
  static char odom[] = "odom";
  static char base[] = "base";

  if (strcmp(word[0], "move") == 0) {
    fill(0, odom, word[1], atof(word[2]));
    return rclc_tf_broadcaster_send(&moving, transforms, 1);
  }
  if (strcmp(word[0], "pair") == 0) {
    fill(0, odom, "base", atof(word[1]));
    fill(1, base, "arm", atof(word[1]) + 1.0);
    return rclc_tf_broadcaster_send(&moving, transforms, 2);
  }
  if (strcmp(word[0], "fix") == 0) {
    fill(0, base, word[1], atof(word[2]));
    return rclc_static_tf_broadcaster_send(&fixed, transforms, 1);
  }
  if (strcmp(word[0], "fixed") == 0) {
    fill(0, base, word[1], 0.25);
    fill(1, base, word[2], 0.5);
    return rclc_static_tf_broadcaster_send(&fixed, transforms, 2);
  }
  if (strcmp(word[0], "many") == 0) {
    for (size_t i = 0; i < MOST; ++i) {
      fill(i, odom, "many", 0.0);
    }
    return rclc_tf_broadcaster_send(&moving, transforms, MOST);
  }
  return refuse(word[0]);
}

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  check(rclc_support_init(&support, 0, NULL, &allocator), "init");
  check(rclc_node_init_default(&node, "robot", "", &support), "node");
  check(rclc_tf_broadcaster_init(&moving, &node), "broadcaster");
  check(rclc_static_tf_broadcaster_init(&fixed, &node), "static broadcaster");
  check(rclc_executor_init(&executor, &support.context, 1, &allocator), "executor");
  obey(&executor, 5, run);
  check(faults == 0u ? RCL_RET_OK : RCL_RET_ERROR, last_error);
  check(rclc_executor_fini(&executor), "executor fini");
  check(rclc_static_tf_broadcaster_fini(&fixed, &node), "static fini");
  check(rclc_tf_broadcaster_fini(&moving, &node), "fini");
  check(rcl_node_fini(&node), "node fini");
  check(rclc_support_fini(&support), "support fini");
  return 0;
}
