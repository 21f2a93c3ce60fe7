/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Decodes each body of decoded_bodies.h, which test_decoded_bodies.py writes, between two marks. The messages have more
 * room than any body has elements: those of one sequence share it, and so do all strings.
 */
#include "measured.h"

#include "decoded_bodies.h"

#include <diagnostic_msgs/msg/diagnostic_array.h>
#include <microros/cdr_decode.h>
#include <rclc/rclc.h>
#include <rosidl_runtime_c/message_type_support_struct.h>
#include <sensor_msgs/msg/joint_state.h>
#include <tf2_msgs/msg/tf_message.h>
#include <visualization_msgs/msg/marker_array.h>

enum { PLACES = 64, CHARACTERS = 4096 };

static volatile bool is_running;
static char characters[CHARACTERS];
static double doubles[PLACES * 16];
static rosidl_runtime_c__String names[PLACES];
static diagnostic_msgs__msg__KeyValue values[PLACES];
static diagnostic_msgs__msg__DiagnosticStatus status[PLACES];
static geometry_msgs__msg__TransformStamped transforms[PLACES];
static visualization_msgs__msg__Marker markers[PLACES];
static diagnostic_msgs__msg__DiagnosticArray diagnostics;
static tf2_msgs__msg__TFMessage frames;
static visualization_msgs__msg__MarkerArray shapes;
static sensor_msgs__msg__JointState joints;

#define GIVE(sequence, storage, places) \
  do { \
    (sequence).data = (void *)(storage); \
    (sequence).capacity = (places); \
  } while (false)

static void markers_fill(visualization_msgs__msg__Marker * marker)
{
  GIVE(marker->header.frame_id, characters, CHARACTERS);
  GIVE(marker->ns, characters, CHARACTERS);
  GIVE(marker->points, doubles, PLACES);
  GIVE(marker->colors, doubles, PLACES);
  GIVE(marker->texture_resource, characters, CHARACTERS);
  GIVE(marker->texture.header.frame_id, characters, CHARACTERS);
  GIVE(marker->texture.format, characters, CHARACTERS);
  GIVE(marker->texture.data, doubles, PLACES);
  GIVE(marker->uv_coordinates, doubles, PLACES);
  GIVE(marker->text, characters, CHARACTERS);
  GIVE(marker->mesh_resource, characters, CHARACTERS);
  GIVE(marker->mesh_file.filename, characters, CHARACTERS);
  GIVE(marker->mesh_file.data, doubles, PLACES);
}

static void messages_fill(void)
{
  for (uint32_t i = 0; i < (uint32_t)PLACES; ++i) {
    GIVE(names[i], characters, CHARACTERS);
    GIVE(values[i].key, characters, CHARACTERS);
    GIVE(values[i].value, characters, CHARACTERS);
    GIVE(status[i].name, characters, CHARACTERS);
    GIVE(status[i].message, characters, CHARACTERS);
    GIVE(status[i].hardware_id, characters, CHARACTERS);
    GIVE(status[i].values, values, PLACES);
    GIVE(transforms[i].header.frame_id, characters, CHARACTERS);
    GIVE(transforms[i].child_frame_id, characters, CHARACTERS);
    markers_fill(&markers[i]);
  }
  GIVE(diagnostics.header.frame_id, characters, CHARACTERS);
  GIVE(diagnostics.status, status, PLACES);
  GIVE(frames.transforms, transforms, PLACES);
  GIVE(shapes.markers, markers, PLACES);
  GIVE(joints.header.frame_id, characters, CHARACTERS);
  GIVE(joints.name, names, PLACES);
  GIVE(joints.position, doubles, PLACES);
  GIVE(joints.velocity, doubles, PLACES);
  GIVE(joints.effort, doubles, PLACES);
}

static const microros_message_type_t * type_of(const rosidl_message_type_support_t * support)
{
  return support->data;
}

int main(void)
{
  const microros_message_type_t * types[] = {
    type_of(ROSIDL_GET_MSG_TYPE_SUPPORT(diagnostic_msgs, msg, DiagnosticArray)),
    type_of(ROSIDL_GET_MSG_TYPE_SUPPORT(tf2_msgs, msg, TFMessage)),
    type_of(ROSIDL_GET_MSG_TYPE_SUPPORT(visualization_msgs, msg, MarkerArray)),
    type_of(ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, JointState))};
  void * const messages[] = {&diagnostics, &frames, &shapes, &joints};

  if (is_running) { /* never; so that the image has the plan of the library */
    (void)rclc_support_init(NULL, 0, NULL, NULL);
  }
  messages_fill();
  for (uint32_t i = 0; i < sizeof(table) / sizeof(table[0]); ++i) {
    cdr_fault_t fault;
    cdr_in_t in = {&bodies[table[i].first], table[i].size, 0, table[i].swap, false, &fault};

    mark();
    types[table[i].type]->decode(&in, messages[table[i].type]);
    mark();
    if (in.failed == table[i].whole) {
      finish(); /* the bodies are not what they are meant to be */
    }
  }
  mark();
  finish();
}
