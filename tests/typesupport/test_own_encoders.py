# SPDX-License-Identifier: Apache-2.0
"""Encoders under the limits of publishers, compiled and run: largest sizes, bytes, and what each refuses.

The type's own encoder, whose bytes are held against rclpy (test_bytes.py), is the oracle for bytes.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.interfaces.find import shipped_folder
from tests.support.slices import first
from tests.support.typesupport.build import WARNINGS, run

pytestmark = pytest.mark.builds

APPLICATION = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: arm
    publishers:
      - {topic: few, type: sensor_msgs/msg/JointState, limits: {name: {sequence: 2, string: 8}, position: 3}}
      - {topic: brief, type: sensor_msgs/msg/JointState, limits: {header: {string: 3}}}
      - {topic: all, type: sensor_msgs/msg/JointState}
      - {topic: again, type: sensor_msgs/msg/JointState, limits: {header: {string: 3}}}
      - {topic: near, type: visualization_msgs/msg/MarkerArray, limits: {markers: {sequence: 1, string: 5}}}
      - {topic: tree, type: visualization_msgs/msg/MarkerArray}
      - {topic: alone, type: visualization_msgs/msg/Marker}
limits: {"*": {string: 16, sequence: 6}}
transport: {mtu: 60000}
"""

PROGRAM = r"""
#include <microros/message_type.h>
#include <sensor_msgs/msg/joint_state.h>
#include <visualization_msgs/msg/marker_array.h>

#include <stdio.h>
#include <string.h>

static uint8_t body[60000];
static uint8_t oracle[60000];

/* All that fits: strings of 'x', sequences of zeros. */
static void fill_string(rosidl_runtime_c__String * string)
{
  memset(string->data, 'x', string->capacity - 1u);
  string->size = string->capacity - 1u;
}

static void fill_state(sensor_msgs__msg__JointState * m)
{
  fill_string(&m->header.frame_id);
  m->name.size = m->name.capacity;
  for (size_t i = 0u; i < m->name.size; ++i) {
    fill_string(&m->name.data[i]);
  }
  m->position.size = m->position.capacity;
  m->velocity.size = m->velocity.capacity;
  m->effort.size = m->effort.capacity;
  memset(m->position.data, 1, m->position.size * sizeof(double));
  memset(m->velocity.data, 2, m->velocity.size * sizeof(double));
  memset(m->effort.data, 3, m->effort.size * sizeof(double));
}

static void fill_markers(visualization_msgs__msg__MarkerArray * m)
{
  m->markers.size = m->markers.capacity;
  for (size_t i = 0u; i < m->markers.size; ++i) {
    visualization_msgs__msg__Marker * marker = &m->markers.data[i];

    fill_string(&marker->header.frame_id);
    fill_string(&marker->ns);
    fill_string(&marker->text);
    fill_string(&marker->texture_resource);
    fill_string(&marker->mesh_resource);
    fill_string(&marker->texture.header.frame_id);
    fill_string(&marker->texture.format);
    fill_string(&marker->mesh_file.filename);
    marker->points.size = marker->points.capacity;
    marker->colors.size = marker->colors.capacity;
    marker->uv_coordinates.size = marker->uv_coordinates.capacity;
    marker->texture.data.size = marker->texture.data.capacity;
    marker->mesh_file.data.size = marker->mesh_file.data.capacity;
    memset(marker->texture.data.data, 4, marker->texture.data.size);
    memset(marker->mesh_file.data.data, 5, marker->mesh_file.data.size);
  }
}

/* The size under the own limits, or what is refused; its bytes are those of the type's encoder. */
static void show(const microros_message_type_t * own, const microros_message_type_t * type, const void * message)
{
  cdr_fault_t fault = {.field = "", .kind = CDR_FAULT_VALUE};
  cdr_fault_t again = {.field = "", .kind = CDR_FAULT_VALUE};
  uint32_t size;
  const uint32_t measured = own->encoded_size(message, &again);

  memset(body, 0xEE, sizeof(body));
  memset(oracle, 0xEE, sizeof(oracle));
  size = own->encode(message, body, &fault);
  if (size == 0u) {
    printf("%s %u above %u, ", fault.field, (unsigned)fault.found, (unsigned)fault.fits);
    puts(measured == 0u && strcmp(fault.field, again.field) == 0 && fault.kind == CDR_FAULT_LIMIT ? "refused" : "?");
    return;
  }
  fault.field = NULL;
  if (type->encode(message, oracle, &fault) != size || memcmp(body, oracle, sizeof(body)) != 0) {
    puts("other bytes than the type's");
    return;
  }
  printf("%u %s\n", (unsigned)size, size == own->max_encoded_size ? "largest" : "less");
  puts(measured == size && strcmp(own->dds_type_name, type->dds_type_name) == 0 ? "same" : "?");
}

#define TYPE(pkg, name) ROSIDL_GET_MSG_TYPE_SUPPORT(pkg, msg, name)->data

int main(void)
{
  static sensor_msgs__msg__JointState__Storage state_storage;
  static sensor_msgs__msg__JointState__on__few__Storage few_storage;
  static visualization_msgs__msg__MarkerArray__Storage markers_storage;
  static visualization_msgs__msg__MarkerArray__on__near__Storage near_storage;
  sensor_msgs__msg__JointState state;
  visualization_msgs__msg__MarkerArray markers;
  const microros_message_type_t * few = &sensor_msgs__msg__JointState__on__few__message_type;
  const microros_message_type_t * brief = &sensor_msgs__msg__JointState__on__brief__message_type;
  const microros_message_type_t * near_ = &visualization_msgs__msg__MarkerArray__on__near__message_type;

  sensor_msgs__msg__JointState__on__few__bind(&state, &few_storage);
  fill_state(&state);
  show(few, TYPE(sensor_msgs, JointState), &state);
  show(brief, TYPE(sensor_msgs, JointState), &state);
  sensor_msgs__msg__JointState__bind(&state, &state_storage);
  fill_state(&state);
  show(TYPE(sensor_msgs, JointState), TYPE(sensor_msgs, JointState), &state);
  show(brief, TYPE(sensor_msgs, JointState), &state);
  state.header.frame_id.size = 3u;
  show(brief, TYPE(sensor_msgs, JointState), &state);
  show(few, TYPE(sensor_msgs, JointState), &state);
  state.name.size = 2u;
  show(few, TYPE(sensor_msgs, JointState), &state);
  state.name.data[0].size = 8u;
  state.name.data[1].size = 8u;
  show(few, TYPE(sensor_msgs, JointState), &state);
  state.position.size = 3u;
  show(few, TYPE(sensor_msgs, JointState), &state);

  visualization_msgs__msg__MarkerArray__on__near__bind(&markers, &near_storage);
  fill_markers(&markers);
  show(near_, TYPE(visualization_msgs, MarkerArray), &markers);
  show(TYPE(visualization_msgs, Marker), TYPE(visualization_msgs, Marker), &markers.markers.data[0]);
  visualization_msgs__msg__MarkerArray__bind(&markers, &markers_storage);
  fill_markers(&markers);
  show(TYPE(visualization_msgs, MarkerArray), TYPE(visualization_msgs, MarkerArray), &markers);
  show(near_, TYPE(visualization_msgs, MarkerArray), &markers);
  markers.markers.size = 1u;
  show(near_, TYPE(visualization_msgs, MarkerArray), &markers);
  return 0;
}
"""

SHOWN = """\
208 largest
same
header.frame_id 16 above 3, refused
344 largest
same
header.frame_id 16 above 3, refused
328 largest
same
name 6 above 2, refused
name[] 16 above 8, refused
position 6 above 3, refused
192 less
same
310 largest
same
310 less
same
3935 largest
same
markers 6 above 1, refused
header.frame_id 16 above 5, refused
"""

COMPILERS = (
    ("gcc", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"),
    ("gcc", "-O2", "-m32"),
    ("clang", "-O1"),
)


@pytest.fixture(scope="module")
def out(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("encoders")
    (place / "microros.yaml").write_text(APPLICATION)
    options = compiler.Options(config=place / "microros.yaml", interface_paths=(shipped_folder(),))
    folder = compiler.generate(options, place / "out").out
    (place / "program.c").write_text(PROGRAM)
    return folder


@pytest.mark.parametrize("compiler", first(COMPILERS), ids=" ".join)
def test_each_encoder_holds_to_its_own_limits(out: Path, compiler: tuple[str, ...]) -> None:
    if shutil.which(compiler[0]) is None:
        pytest.skip(f"no {compiler[0]}")
    sources = sorted(p for end in ("type_support", "storage") for p in (out / "src").rglob(f"*__{end}.c"))
    image = out.parent / "program"
    run([*compiler, *WARNINGS, f"-I{out}/include", out.parent / "program.c", *sources, "-o", image])
    assert run([image]) == SHOWN


def test_equal_limits_have_one_encoder(out: Path) -> None:
    header = (out / "include/sensor_msgs/msg/detail/joint_state__type_support.h").read_text()
    assert header.count("extern const microros_message_type_t") == 2
    assert "the publisher on /brief of /arm, the publisher on /again of /arm" in header
