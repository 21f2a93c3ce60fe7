# SPDX-License-Identifier: Apache-2.0
"""rmw_deserialize and the exact size, through the built library; and that nothing of it is there unasked."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen.cli import main as cli
from microros_gen.interfaces.find import shipped_folder

pytestmark = [
    pytest.mark.skipif(shutil.which("gcc") is None or shutil.which("nm") is None, reason="no gcc or no nm"),
    pytest.mark.builds,
    pytest.mark.system,
]

APPLICATION = """\
version: 1
profiles: [pure_sender]
components: [{components}]
interfaces: [sensor_msgs/msg/JointState, sensor_msgs/msg/PointCloud2, shape_msgs/msg/SolidPrimitive]
limits: {{"*": {{string: 5, sequence: 2}}, shape_msgs/msg/SolidPrimitive: {{dimensions: 3, polygon: 2}}}}
memory: {{arena: 0}}
"""

PROGRAM = r"""
#include <microros/message_type.h>
#include <rcl/rcl.h>
#include <rmw/rmw.h>
#include <sensor_msgs/msg/joint_state.h>
#include <sensor_msgs/msg/point_cloud2.h>
#include <shape_msgs/msg/solid_primitive.h>
#include <stdio.h>
#include <string.h>

static sensor_msgs__msg__JointState sent, found;
static sensor_msgs__msg__PointCloud2 cloud;
static sensor_msgs__msg__PointCloud2__Storage cloud_storage;
static shape_msgs__msg__SolidPrimitive shape;
static shape_msgs__msg__SolidPrimitive__Storage shape_storage;
static sensor_msgs__msg__JointState__Storage sent_storage, found_storage;
static uint8_t bytes[512];
static rmw_serialized_message_t buffer = {bytes, 0, sizeof(bytes), {0}};

static void show(const char * what, rmw_ret_t result)
{
  printf("%s: %d %s\n", what, (int)result, result == RMW_RET_OK ? "" : rcl_get_error_string().str);
  rcl_reset_error();
}

static void fill(sensor_msgs__msg__JointState * message)
{
  message->header.stamp.sec = 0x01020304;
  memcpy(message->header.frame_id.data, "base", 5);
  message->header.frame_id.size = 4;
  memcpy(message->name.data[0].data, "joint", 6);
  message->name.data[0].size = 5;
  message->name.size = 1;
  message->position.data[0] = 0.5;
  message->position.data[1] = -2.0;
  message->position.size = 2;
}

/* A member of an element, a bound, and data that are not there. */
static void refuse_members(void)
{
  const rosidl_message_type_support_t * const of_cloud = ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, PointCloud2);
  const rosidl_message_type_support_t * const of_shape =
    ROSIDL_GET_MSG_TYPE_SUPPORT(shape_msgs, msg, SolidPrimitive);
  size_t size = 0;

  sensor_msgs__msg__PointCloud2__bind(&cloud, &cloud_storage);
  shape_msgs__msg__SolidPrimitive__bind(&shape, &shape_storage);
  cloud.fields.size = 2;
  memcpy(cloud.fields.data[1].name.data, "inten", 6);
  cloud.fields.data[1].name.size = 5;
  show("cloud", rmw_serialize(&cloud, of_cloud, &buffer));
  cloud.fields.data[1].name.capacity = 4;
  show("element read", rmw_deserialize(&buffer, of_cloud, &cloud));
  cloud.fields.data[1].name.capacity = 6;
  buffer.buffer_length -= 30;
  show("element cut", rmw_deserialize(&buffer, of_cloud, &cloud));
  cloud.fields.data[1].name.size = 6;
  show("element sent", rmw_uros_get_serialized_message_size(&cloud, of_cloud, &size));
  cloud.fields.data = NULL;
  show("no data", rmw_serialize(&cloud, of_cloud, &buffer));
  shape.dimensions.size = 4;
  show("bound sent", rmw_serialize(&shape, of_shape, &buffer));
  memset(bytes, 0, 32);
  bytes[1] = 1;
  bytes[8] = 4;
  buffer.buffer_length = 52;
  show("bound read", rmw_deserialize(&buffer, of_shape, &shape));
}

int main(void)
{
  const rosidl_message_type_support_t * const support =
    ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, JointState);
  microros_message_type_t only_sent = *(const microros_message_type_t *)support->data;
  const rosidl_message_type_support_t other = {support->typesupport_identifier, &only_sent};
  size_t size = 0, length;

  sensor_msgs__msg__JointState__bind(&sent, &sent_storage);
  sensor_msgs__msg__JointState__bind(&found, &found_storage);
  fill(&sent);
  show("exact", rmw_uros_get_serialized_message_size(&sent, support, &size));
  show("serialize", rmw_serialize(&sent, support, &buffer));
  printf("%d\n", size == buffer.buffer_length);
  show("read", rmw_deserialize(&buffer, support, &found));
  printf("%s %s %g %d\n", found.header.frame_id.data, found.name.data[0].data, found.position.data[1],
    sensor_msgs__msg__JointState__are_equal(&sent, &found));
  length = buffer.buffer_length;
  buffer.buffer_length = 30;
  show("cut", rmw_deserialize(&buffer, support, &found));
  buffer.buffer_length = 3;
  show("no header", rmw_deserialize(&buffer, support, &found));
  buffer.buffer_length = length;
  bytes[1] = 3;
  show("PL_CDR", rmw_deserialize(&buffer, support, &found));
  bytes[1] = 1;
  found.position.capacity = 1;
  show("full", rmw_deserialize(&buffer, support, &found));
  show("NULL", rmw_deserialize(&buffer, support, NULL));
  bytes[1] = 0;
  show("other order", rmw_deserialize(&buffer, support, &found));
  only_sent.decode = NULL;
  show("only sent", rmw_deserialize(&buffer, &other, &found));
  sent.position.size = 3;
  show("too much", rmw_uros_get_serialized_message_size(&sent, support, &size));
  refuse_members();
  return 0;
}
"""

EXPECTED = """\
exact: 0 
serialize: 0 
1
read: 0 
base joint -2 1
cut: 1 sensor_msgs/msg/JointState.name[]: the message ends: 4 bytes needed, 2 left
no header: 1 sensor_msgs/msg/JointState.encapsulation: the message ends: 4 bytes needed, 3 left
PL_CDR: 1 sensor_msgs/msg/JointState: representation 3 is not plain CDR (0 or 1)
full: 1 capacity for 1: set limits: {sensor_msgs/msg/JointState: {position: 2}}, or that of your buffer
NULL: 11 serialized_message, type_support or ros_message: NULL or not initialized
other order: 1 sensor_msgs/msg/JointState.header.frame_id: the message ends: 83886080 bytes needed, 52 left
only sent: 3 sensor_msgs/msg/JointState has no decoder: no profile receives it
too much: 1 limit 2: set limits: {sensor_msgs/msg/JointState: {position: 3}}
cloud: 0 
element read: 1 capacity for 3: set limits: {sensor_msgs/msg/PointCloud2: {fields: {name: 5}}}, or that of your buffer
element cut: 1 sensor_msgs/msg/PointCloud2.fields[1].offset: the message ends: 6 bytes needed, 1 left
element sent: 1 limit 5: set limits: {sensor_msgs/msg/PointCloud2: {fields: {name: 6}}}
no data: 1 sensor_msgs/msg/PointCloud2.fields has a size, 2, and no data: NULL
bound sent: 1 shape_msgs/msg/SolidPrimitive.dimensions: 4, and its interface file allows 3
bound read: 1 shape_msgs/msg/SolidPrimitive.dimensions: 4, and its interface file allows 3
"""  # noqa: W291 (printed so)


def build(folder: Path, components: str) -> Path:
    """Build the library and return the output folder."""
    config = folder / "microros.yaml"
    config.write_text(APPLICATION.format(components=components))
    arguments = [
        "build",
        "-c",
        str(config),
        "--interface-path",
        str(shipped_folder()),
        "-o",
        str(folder / "out"),
    ]
    with pytest.raises(SystemExit) as end:
        cli.main(arguments)
    assert end.value.code == 0
    return folder / "out"


def symbols(out: Path) -> set[str]:
    """Return what the library defines."""
    output = subprocess.run(
        ["nm", "-P", "--defined-only", "lib/libmicroros.a"],
        cwd=out,
        capture_output=True,
        text=True,
        check=True,
    )
    return {line.split()[0] for line in output.stdout.splitlines() if len(line.split()) > 2}


def test_messages_are_read_and_refused_with_a_reason(tmp_path: Path) -> None:
    out = build(tmp_path, "+cdr_decode")
    assert {"rmw_deserialize", "cdr_get_string", "sensor_msgs__msg__JointState__decode"} <= symbols(out)
    source, program = tmp_path / "main.c", tmp_path / "main"
    source.write_text(PROGRAM)
    command = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{out}/include", str(source)]
    subprocess.run([*command, out / "lib" / "libmicroros.a", "-o", program], check=True)
    printed = subprocess.run([program], capture_output=True, text=True, check=True)
    assert printed.stdout.replace(" in microros.yaml", "") == EXPECTED


@pytest.mark.system
def test_nothing_that_decodes_is_there_unasked(tmp_path: Path) -> None:
    out = build(tmp_path, "")
    assert not [s for s in symbols(out) if "decode" in s or "deserialize" in s or s.startswith("cdr_get")]
    assert not list(out.rglob("*decode*"))
    source = next(out.rglob("joint_state__type_support.c")).read_text()
    assert ".decode = NULL" in source
