# SPDX-License-Identifier: Apache-2.0
"""Restates interface packages: reads their interface files and prints names, types, constants and defaults.

Nothing else of the read files is kept, comments least of all; the short notes below are this project's own.
Run it when a new distribution is taken up:

    python -m tests.tools.restate_idl SHARE… [--output microros_gen/idl] [--package NAME…]

SHARE is a folder of packages, for example `share` of an installed ROS 2.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from microros_gen.diagnostics import Diagnostics, UserError
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import Interface, resolve_interfaces
from microros_gen.interfaces.derived import make_declaration, parts_of
from microros_gen.interfaces.find import InterfaceFinder, shipped_folder
from microros_gen.interfaces.msg.text import declaration_text
from microros_gen.interfaces.types import Declaration, Message

PACKAGES = (
    "action_msgs",
    "actionlib_msgs",
    "builtin_interfaces",
    "diagnostic_msgs",
    "example_interfaces",
    "geometry_msgs",
    "lifecycle_msgs",
    "nav_msgs",
    "rcl_interfaces",
    "rmw_dds_common",
    "rosgraph_msgs",
    "sensor_msgs",
    "service_msgs",
    "shape_msgs",
    "std_msgs",
    "std_srvs",
    "stereo_msgs",
    "tf2_msgs",
    "trajectory_msgs",
    "type_description_interfaces",
    "unique_identifier_msgs",
    "visualization_msgs",
)

# Units of REP-103 and what a value means where the name does not say it. In this project's own words.
NOTES: Mapping[str, Mapping[str, str]] = {
    "builtin_interfaces/msg/Duration": {"sec": "s, may be negative", "nanosec": "ns, always added to sec"},
    "builtin_interfaces/msg/Time": {
        "sec": "s since the epoch of the clock",
        "nanosec": "ns, always added to sec",
    },
    "geometry_msgs/msg/Accel": {"linear": "m/s^2", "angular": "rad/s^2"},
    "geometry_msgs/msg/Inertia": {"m": "kg", "com": "m", "ixx": "kg m^2"},
    "geometry_msgs/msg/Point": {"x": "m", "y": "m", "z": "m"},
    "geometry_msgs/msg/Point32": {"x": "m", "y": "m", "z": "m"},
    "geometry_msgs/msg/Pose2D": {"x": "m", "y": "m", "theta": "rad"},
    "geometry_msgs/msg/PoseWithCovariance": {
        "covariance": "row major, 6x6: x y z, then rotation about X Y Z"
    },
    "geometry_msgs/msg/Twist": {"linear": "m/s", "angular": "rad/s"},
    "geometry_msgs/msg/TwistWithCovariance": {"covariance": "row major, 6x6: linear x y z, angular x y z"},
    "geometry_msgs/msg/Wrench": {"force": "N", "torque": "N m"},
    "sensor_msgs/msg/BatteryState": {
        "voltage": "V",
        "temperature": "degree Celsius, NaN where not measured",
        "current": "A, negative while discharging, NaN where not measured",
        "charge": "A h, NaN where not measured",
        "capacity": "A h, NaN where not measured",
        "design_capacity": "A h",
        "percentage": "0 to 1, NaN where not measured",
    },
    "sensor_msgs/msg/FluidPressure": {"fluid_pressure": "Pa", "variance": "Pa^2, 0: unknown"},
    "sensor_msgs/msg/Illuminance": {"illuminance": "lx", "variance": "lx^2, 0: unknown"},
    "sensor_msgs/msg/Imu": {
        "orientation_covariance": "rad^2, row major, about X Y Z; [0] is -1: no orientation",
        "angular_velocity": "rad/s",
        "angular_velocity_covariance": "(rad/s)^2, row major; [0] is -1: not measured",
        "linear_acceleration": "m/s^2",
        "linear_acceleration_covariance": "(m/s^2)^2, row major; [0] is -1: not measured",
    },
    "sensor_msgs/msg/JointState": {"position": "rad or m", "velocity": "rad/s or m/s", "effort": "N m or N"},
    "sensor_msgs/msg/LaserScan": {
        "angle_min": "rad",
        "angle_max": "rad",
        "angle_increment": "rad",
        "time_increment": "s between two measurements",
        "scan_time": "s between two scans",
        "range_min": "m",
        "range_max": "m",
        "ranges": "m",
    },
    "sensor_msgs/msg/MagneticField": {
        "magnetic_field": "T",
        "magnetic_field_covariance": "T^2, row major, about x y z",
    },
    "sensor_msgs/msg/NavSatFix": {
        "latitude": "degree, north is positive",
        "longitude": "degree, east is positive",
        "altitude": "m above the WGS 84 ellipsoid",
        "position_covariance": "m^2, row major, east north up",
    },
    "sensor_msgs/msg/Range": {"field_of_view": "rad", "min_range": "m", "max_range": "m", "range": "m"},
    "sensor_msgs/msg/RelativeHumidity": {"relative_humidity": "0 to 1", "variance": "0: unknown"},
    "sensor_msgs/msg/Temperature": {
        "temperature": "degree Celsius",
        "variance": "square of that, 0: unknown",
    },
    "std_msgs/msg/Header": {"stamp": "when the data was taken", "frame_id": "coordinate frame of the data"},
}


def restated(message: Message) -> Message:
    """Return `message` without its comments, with the notes of this project."""
    notes = dict(NOTES.get(str(message.name), {}))
    fields = tuple(replace(f, comment=(n,) if (n := notes.pop(f.name, "")) else ()) for f in message.fields)
    if notes:
        raise SystemExit(f"{message.name} has no field {', '.join(notes)}")
    constants = tuple(replace(constant, comment=()) for constant in message.constants)
    return replace(message, fields=fields, constants=constants, comment=())


def restated_declaration(declaration: Declaration) -> Declaration:
    """Return a message, service or action as `restated` makes its messages."""
    if isinstance(declaration, Message):
        return restated(declaration)
    return make_declaration(
        declaration.name, tuple(restated(message) for _, message in parts_of(declaration))
    )


def restate(interface: Interface, output: Path) -> None:
    """Write one interface below `output`."""
    name = interface.name
    target = output / name.package / name.kind / f"{name.name}.{name.kind}"
    target.parent.mkdir(parents=True, exist_ok=True)
    text = declaration_text(restated_declaration(interface.declaration))
    target.write_text(text, encoding="utf-8", newline="\n")


def main() -> None:
    """Restate the packages and say how many types each has."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("share", type=Path, nargs="+", help="folder of packages to read")
    parser.add_argument("--output", type=Path, default=shipped_folder(), help="folder to write")
    parser.add_argument("--package", action="append", help="only this package")
    options = parser.parse_args()
    finder = InterfaceFinder(paths=tuple(options.share), shipped=shipped_folder())
    try:
        for package in options.package or PACKAGES:
            diagnostics = Diagnostics()
            interfaces = resolve_interfaces((Named(package),), finder, diagnostics)
            diagnostics.check()
            for name in interfaces.roots:
                restate(interfaces.interfaces[name], options.output)
            sys.stdout.write(f"{package}: {len(interfaces.roots)}\n")
    except UserError as fault:
        sys.exit(str(fault))


if __name__ == "__main__":
    main()
