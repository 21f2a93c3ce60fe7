# SPDX-License-Identifier: Apache-2.0
"""What is proposed for sources as people write them, and what of them is told to be not known."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from microros_gen.components.diagnosis.plan import DiagnosisPlan
from microros_gen.diagnostics import UserError
from microros_gen.migrate.draft import DraftEndpoint
from tests.support.components.rendered import planned
from tests.support.examples import examples
from tests.support.migrate.rclc import NODE, adopted, program, reasons

INT32 = "ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Int32)"


def endpoints(*texts: str) -> list[tuple[str, str, str]]:
    return [(e.kind, e.name, e.type) for node in adopted(*texts).draft.nodes for e in node.endpoints]


def only(text: str) -> DraftEndpoint:
    (endpoint,) = adopted(text).draft.nodes[0].endpoints
    return endpoint


@pytest.mark.parametrize(
    ("topic", "before"),
    [
        ('"chatter"', ""),
        ('"chat" /* said */ "ter"', ""),
        ("TOPIC", '#define TOPIC "chatter"'),
        ("PREFIX TOPIC", '#ifndef PREFIX\n#define PREFIX\n#endif\n#define TOPIC "chatter"'),
        ("TOPIC", '#define PART "chat"\n#define TOPIC PART \\\n  "ter"'),
        ("topic", 'static const char * const topic = "chatter";'),
        ("topic", 'const char topic[] = "chatter"; /* char topic[] = "other"; */'),
        ("config.topic", 'static config_t config = {0};\nvoid set(void) { config.topic = "chatter"; }'),
        ('(const char *)"chatter"', ""),
        ('u8"chatter"', ""),
    ],
)
def test_a_topic_is_found(topic: str, before: str) -> None:
    text = program(f"rclc_publisher_init_default(&p, &node, {INT32}, {topic});", before)
    if topic.startswith("(const"):
        assert "is worked out when the program runs" in reasons(text)[0]
        return
    assert endpoints(text) == [("publisher", "chatter", "std_msgs/msg/Int32")]
    assert reasons(text) == []


@pytest.mark.parametrize(
    ("topic", "before", "reason"),
    [
        ("argv[1]", "", "`argv[1]` is a parameter of main()"),
        ("names[i]", 'char * names[] = {"a", "b"};', "`names[i]` is worked out when the program runs"),
        ("a ? b : c", "", "is worked out when the program runs"),
        ("make()", "", "is worked out when the program runs"),
        ("elsewhere", "extern char * elsewhere;", "the value of `elsewhere` is not in these sources"),
        ("t", 'void a(void) { t = "x"; }\nvoid b(void) { t = "y"; }', "`t` gets more than one value"),
        ("NULL", "", "it is NULL"),
    ],
)
def test_an_unknown_topic_is_reported_with_its_reason(topic: str, before: str, reason: str) -> None:
    text = program(f"rclc_publisher_init_default(&p, &node, {INT32}, {topic});", before)
    text = text.replace("main(void)", "main(int argc, char ** argv)")
    assert only(text).name == ""
    (reported,) = reasons(text)
    line = text[: text.index("rclc_publisher")].count("\n") + 1
    assert reported.startswith(f"0.c:{line}:3: the topic of the publisher: ")
    assert reported.endswith(reason)


@pytest.mark.parametrize(
    "text",
    [
        "// rclc_publisher_init_default(&p, &node, T, t);",
        "// a line that goes on \\\n rclc_publisher_init_default(&p, &node, T, t);",
        "/* rclc_publisher_init_default(&p, &node, T, t); */",
        'puts("rclc_publisher_init_default(&p, &node, T, t);");',
        "#if 0\n  rclc_publisher_init_default(&p, &node, T, t);\n#endif",
        "#if 0\n#ifdef X\n rclc_publisher_init_default(&p, &node, T, t);\n#endif\n#endif",
        'puts(R"(rclc_publisher_init_default(&p, &node, T, t))");',
    ],
)
def test_what_is_no_code_is_not_read(text: str) -> None:
    assert endpoints(program(text)) == []
    assert reasons(program(text)) == []


def test_declarations_are_no_calls() -> None:
    before = "rcl_ret_t rclc_publisher_init_default(rcl_publisher_t *, const rcl_node_t *, T, const char *);"
    assert endpoints(program("", before)) == []


def test_a_call_over_lines_in_a_macro_of_the_program() -> None:
    call = f'RCCHECK(rclc_publisher_init_default(\n    &p, // where\n    &node,\n    {INT32},\n    "a"));'
    before = "#define RCCHECK(fn) { rcl_ret_t rc = fn; if (rc != RCL_RET_OK) { error_loop(); } }"
    assert endpoints(program(call, before)) == [("publisher", "a", "std_msgs/msg/Int32")]


def test_a_macro_that_creates_an_entity_is_reported() -> None:
    before = f"#define PUBLISHER(p, topic) rclc_publisher_init_default(&p, &node, {INT32}, topic)"
    text = program('PUBLISHER(p, "a");', before)
    assert reasons(text) == [
        "0.c:1:1: the macro PUBLISHER creates something; what its uses create is not known here"
    ]


def test_both_sides_of_a_condition_are_read_with_a_note() -> None:
    text = program(
        f'#ifdef WIFI\n  rclc_publisher_init_default(&p, &node, {INT32}, "wifi");\n#else\n'
        f'  rclc_publisher_init_default(&p, &node, {INT32}, "wire");\n#endif'
    )
    found = adopted(text).draft.nodes[0].endpoints
    assert [(e.name, [r.text for r in e.remarks]) for e in found] == [
        ("wifi", ["only with `#ifdef WIFI`"]),
        ("wire", ["only with `#else`"]),
    ]
    assert reasons(text) == []


def test_type_supports_in_variables_and_macros() -> None:
    text = program(
        "const rosidl_message_type_support_t * ts = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Bool);\n"
        '  rclc_publisher_init_default(&p, &node, ts, "a");\n'
        "  ts = ROSIDL_GET_MSG_TYPE_SUPPORT(std_msgs, msg, Float32);\n"
        '  rclc_subscription_init_default(&s, &node, ts, "b");\n'
        '  rclc_service_init_default(&v, &node, SERVICE, "c");\n'
        '  rclc_client_init_default(&c, &node, SERVICE, "d");\n',
        "#define SERVICE ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool)",
    )
    assert endpoints(text) == [
        ("publisher", "a", "std_msgs/msg/Bool"),
        ("subscription", "b", "std_msgs/msg/Float32"),
        ("service", "c", "std_srvs/srv/SetBool"),
        ("client", "d", "std_srvs/srv/SetBool"),
    ]
    assert adopted(text).draft.components == ("+services",)


def test_a_type_of_the_wrong_kind_is_reported() -> None:
    wrong = "ROSIDL_GET_SRV_TYPE_SUPPORT(std_srvs, srv, SetBool)"
    text = program(f'rclc_publisher_init_default(&p, &node, {wrong}, "a");')
    assert reasons(text) == ["0.c:5:3: the type of the publisher is std_srvs/srv/SetBool"]


@pytest.mark.parametrize(
    ("call", "qos"),
    [
        ('rclc_publisher_init_best_effort(&p, &node, T, "a");', {"reliability": "best_effort", "depth": 5}),
        ('rclc_publisher_init(&p, &node, T, "a", &rmw_qos_profile_sensor_data);',
         {"reliability": "best_effort", "depth": 5}),
        ('rclc_publisher_init(&p, &node, T, "a", &rmw_qos_profile_default);', {}),
        ("rmw_qos_profile_t q = rmw_qos_profile_default; q.depth = DEPTH;"
         " q.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;"
         ' rclc_subscription_init(&p, &node, T, "a", &q);',
         {"durability": "transient_local", "depth": 3}),
        ("rcl_publisher_options_t o = rcl_publisher_get_default_options();"
         " o.qos.reliability = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;"
         ' rcl_publisher_init(&p, &node, T, "a", &o);', {"reliability": "best_effort"}),
    ],
)  # fmt: skip
def test_qos(call: str, qos: dict[str, object]) -> None:
    text = program(call, f"enum {{ ONE = 1, DEPTH = 1 + 2 }};\n#define T {INT32}")
    assert dict(only(text).qos.settings) == qos
    assert reasons(text) == []


def test_unknown_qos_is_reported() -> None:
    text = program(
        "rmw_qos_profile_t q = rmw_qos_profile_default; q.liveliness = RMW_QOS_POLICY_LIVELINESS_AUTOMATIC;"
        f' rclc_publisher_init(&p, &node, {INT32}, "a", &q);'
    )
    assert reasons(text) == ["0.c:5:50: the QoS: `liveliness` = `RMW_QOS_POLICY_LIVELINESS_AUTOMATIC`"]


@pytest.mark.parametrize(
    ("period", "nanoseconds"),
    [
        ("RCL_MS_TO_NS(100)", 100_000_000),
        ("RCL_S_TO_NS(1)", 1_000_000_000),
        ("RCL_MS_TO_NS(1000 / (float)PERIOD)", 2_000_000),
        ("RCL_MS_TO_NS(PERIOD / 2)", 250_000_000),
        ("RCL_MS_TO_NS(period_ms)", 20_000_000),
        ("1000 * 1000ULL", 1_000_000),
        ("(int64_t)PERIOD * 1'000", 500_000),
        ("0x10", 16),
    ],
)
def test_periods_of_timers(period: str, nanoseconds: int) -> None:
    text = program(
        f"const unsigned int period_ms = 20;\n  rclc_timer_init_default2(&my.Timer_1, &support, {period}, tick, true);",
        "#define PERIOD 500",
    )
    (timer,) = adopted(text).draft.nodes[0].timers
    assert (timer.name, timer.period_ns) == ("timer_1", nanoseconds)
    assert adopted(text).draft.components == ("+timers",)


@pytest.mark.parametrize(
    ("period", "reason"),
    [
        ("rate()", "`rate()` is worked out when the program runs"),
        ("1.5", "is not a number"),
        ("x ? 1 : 2", "runs"),
    ],
)
def test_an_unknown_period_is_reported(period: str, reason: str) -> None:
    text = program(f"rclc_timer_init_default(&t, &support, {period}, tick);")
    (timer,) = adopted(text).draft.nodes[0].timers
    assert timer.period_ns is None
    assert reason in reasons(text)[0]


def test_entities_belong_to_their_nodes() -> None:
    body = (
        'rclc_node_init_default(&b, "b", "deep/er", &support);\n'
        f'  rclc_publisher_init_default(&p, &node, {INT32}, "of_n");\n'
        f'  rclc_publisher_init_default(&q, &b, {INT32}, "of_b");\n'
        f'  rclc_publisher_init_default(&r, which, {INT32}, "of_one_of_them");'
    )
    nodes = adopted(program(body)).draft.nodes
    assert [(n.name, n.namespace, [e.name for e in n.endpoints]) for n in nodes] == [
        ("n", "", ["of_n", "of_one_of_them"]),
        ("b", "deep/er", ["of_b"]),
    ]
    assert reasons(program(body)) == [
        "0.c:8:3: which node the publisher is of: `which` may be one of several"
    ]


def test_an_application_that_creates_everything_again_has_it_once() -> None:
    create = f'{NODE} rclc_publisher_init_default(&p, &node, {INT32}, "a");'
    text = (
        f"void create(void) {{ {create} }}\nvoid again(void) {{ {create} }}\nint main(void) {{ create(); }}"
    )
    nodes = adopted(text).draft.nodes
    assert [(n.name, len(n.endpoints)) for n in nodes] == [("n", 1)]


def test_cpp_sources_with_namespaces_and_classes() -> None:
    text = (
        "namespace robot { class Arm { public: void setup() {\n"
        '  rclc_node_init_default(&this->node, "arm", "", &support);\n'
        f'  rclc_publisher_init_default(&this->p, &this->node, {INT32}, "a");\n'
        '}\n rcl_node_t node; }; }\nextern "C" { int main() { return 0; } }\n'
    )
    assert endpoints(text) == [("publisher", "a", "std_msgs/msg/Int32")]


@pytest.mark.parametrize(
    "other",
    [
        "void Motors::setup() { start(); }",
        "namespace motors { void setup() { start(); } }",
        "class Motors { void setup() { start(); } };",
    ],
)
def test_a_member_named_setup_is_no_second_application(other: str) -> None:
    sketch = f'extern "C" {{ void setup() {{ {NODE} }} }}'
    assert len(adopted(sketch, other).draft.nodes) == 1
    with pytest.raises(UserError, match=r"several applications in these sources: setup\(\) is also in 0.c:1"):
        adopted(sketch, "void setup() {}")


def test_several_applications_are_one_error_with_all_places() -> None:
    with pytest.raises(UserError) as error:
        adopted(*[f"int main(void) {{ {NODE} }}"] * 6)
    [found] = error.value.diagnostics
    assert found.message.endswith("main() is also in 0.c:1, 2.c:1, 3.c:1 and 2 more")
    assert found.span is not None
    assert found.span.source.name == "1.c"


def test_several_files_are_one_program() -> None:
    header = '#ifndef TOPICS_H\n#define TOPICS_H\n#define TOPIC "a"\n#endif'
    text = program(f"rclc_publisher_init_default(&p, &node, {INT32}, TOPIC);")
    assert endpoints(header, text) == [("publisher", "a", "std_msgs/msg/Int32")]
    assert adopted(header, text).draft.nodes[0].endpoints[0].remarks == ()


def test_settings_of_transport_session_and_domain() -> None:
    text = program(
        'rcl_init_options_set_domain_id(&o, 7); rmw_uros_options_set_udp_address("10.0.0.2", "9999", r);'
        " rmw_uros_options_set_client_key(0xBA5EBA11, r);"
    )
    draft = adopted(text).draft
    assert draft.nodes[0].domain_id == 7
    transport = {key: value.value for key, value in draft.groups["transport"].items()}
    assert transport == {"type": "udp", "agent": "10.0.0.2:9999"}
    assert draft.groups["session"]["key"].value == 0xBA5EBA11


@pytest.mark.parametrize(
    ("call", "reason"),
    [
        ("rcl_get_node_names(&node, a, &b, &c);", "rcl_get_node_names takes memory from `memory.arena`"),
        ("rcl_no_such_call(&node);", "rcl_no_such_call is not in this version"),
        (
            "rcl_action_take_goal_request(&server, &header, &request);",
            "rcl_action_take_goal_request is not in this version",
        ),
        ("set_microros_serial_transports(Serial);", "set_microros_serial_transports() is of another library"),
        ("std_msgs__msg__Header__Sequence__create(2);", "takes memory from `memory.arena`"),
        (
            "std_msgs__msg__Header__create(); rclc_subscription_init_default(&s, &node, T, n);",
            "takes memory from `memory.arena`",
        ),
    ],
)
def test_calls_that_need_manual_work_are_reported(call: str, reason: str) -> None:
    assert any(reason in reported for reported in reasons(program(call)))


@pytest.mark.parametrize(
    "call", ["rcl_interfaces__msg__ParameterEvent__init(&e);", "micro_ros_msgs__msg__Graph__fini(&g);"]
)
def test_functions_of_types_are_no_calls_of_the_library(call: str) -> None:
    """Their packages are named as the library's functions are."""
    assert not any("is not in this version" in reason for reason in reasons(program(call)))


def test_messages_that_are_sent_need_no_arena() -> None:
    """They have storage that follows from their limits."""
    reported = reasons(
        program("std_msgs__msg__Header__create(); rosidl_runtime_c__double__Sequence__init(&s, 6);")
    )
    assert not any("memory.arena" in reason for reason in reported)


@pytest.mark.parametrize(
    ("body", "memory"),
    [
        # A piece has 8 bytes in front of it, and is a multiple of 8.
        ("s.data = a.reallocate(s.data, 20, a.state);", {"arena": 32}),
        ("const size_t most = 40; s.data = a->allocate(most, a->state);", {"arena": 48}),
        ("p = a.zero_allocate(3, 4, a.state);", {"arena": 24}),
        ("p = a.allocate(1, a.state); q = a.allocate(9, a.state);", {"arena": 40}),
        ("for (int i = 0; i < 3; i++) { p[i] = a.allocate(40, a.state); }", {"arena": 144}),
        # With an arena alone, what has storage from its limits would come from the arena as well.
        (
            'p = a.allocate(8, a.state); rosidl_runtime_c__String__assign(&m.data, "x");',
            {"arena": 16, "messages": 1},
        ),
        ("p = my_allocate(20, 0); q = allocate(20);", {}),
    ],
)
def test_memory_that_a_program_takes_from_the_allocator(body: str, memory: dict[str, int]) -> None:
    draft = adopted(program(body)).draft
    assert {key: value.value for key, value in draft.groups.get("memory", {}).items()} == memory
    assert not any("memory.arena" in reason for reason in reasons(program(body)))


def test_memory_of_a_size_that_is_not_known_is_a_guess() -> None:
    text = program("p = a.allocate(24, a.state); q = a.allocate(strlen(name), a.state);")
    assert adopted(text).draft.groups["memory"]["arena"].value == 4096 + 32
    assert any(
        "allocate takes memory from `memory.arena`: 4128 is a guess" in reason for reason in reasons(text)
    )


def test_functions_of_the_programs_own_are_no_missing_ones() -> None:
    assert reasons(program("rcl_my_own();", "void rcl_my_own(void)\n{\n}\n")) == []


@pytest.mark.parametrize(
    "text",
    [
        "",
        "int main(void) { return 0; }",
        "}}}{{{((",
        '"unfinished\n',
        "/* unfinished",
        "#define\n#if\n",
        "a = = =",
    ],
)
def test_what_creates_no_node_is_refused(text: str) -> None:
    with pytest.raises(Exception, match="these sources call no function of rclc or rcl"):
        adopted(text)


FRAGMENTS_PER_SAMPLE = st.sampled_from(
    ["{", "}", "(", ")",
     "[", "]", ",", ";", "=", ".", "->", "*", "&", "a", "msg", "7", '"x"', "'", '"', "/*", "*/", "//", "\\",
     "\n", "#if 0\n", "#define A A\n", "\n#endif\n", "A", "sizeof", "enum", "char", "std_msgs__msg__String", "capacity",
     "int f(void) {", "rclc_publisher_init_default(", "rclc_timer_init_default(", NODE, INT32]
)  # fmt: skip


@given(st.lists(FRAGMENTS_PER_SAMPLE, max_size=60))
@settings(max_examples=examples(150), deadline=None)
def test_any_text_is_read_to_its_end(chunks: list[str]) -> None:
    found = adopted(program("") + " ".join(chunks))
    assert found.draft.nodes[0].name == "n"


def test_a_header_that_is_included_selects_its_component() -> None:
    """Nothing of it need be called: an unselected header is one #error."""
    assert adopted(program("", "#include <rclc/executor.h>")).draft.components == ("+executor",)
    assert adopted(program("", '#include "rmw_microros/time_sync.h"')).draft.components == (
        "+node",
        "+time_sync",
    )
    assert adopted(program("", "#include <rclc/rclc.h>")).draft.components == ("+node",)


@pytest.mark.parametrize(
    "call", ["rcl_context_get_rmw_context(&context)", "rcl_get_error_string()", "rcl_reset_error()"]
)
def test_what_a_comment_of_a_header_names_selects_nothing(call: str) -> None:
    assert adopted(program(f"{call};")).draft.components == ("+node",)


def test_several_executors_get_their_places() -> None:
    both = "rclc_executor_init(&one, &context, 1, &allocator);\nrclc_executor_init(&two, &context, 1, &allocator);"
    pools = adopted(program(both)).draft.groups["pools"]
    assert pools["executors"].value == 2
    again = both.replace("&two", "&one")
    assert "pools" not in adopted(program(again)).draft.groups, "one that is made again is one"


@pytest.mark.parametrize(
    ("body", "before"),
    [
        ("pthread_create(&thread, NULL, work, NULL);", ""),
        ('xTaskCreate(work, "w", 512, NULL, 1, NULL);', ""),
        ("std::thread worker(work);", "#include <thread>"),
    ],
)
def test_a_second_task_needs_its_component(body: str, before: str) -> None:
    assert "+multithread" in adopted(program(body, before)).draft.components


LOOP = (
    "for (size_t i = 0; i < {limit}; i++) {{ rclc_publisher_init_default(&p[i], &node, {type}, {topic}); }}"
)


@pytest.mark.parametrize(
    ("limit", "topic", "before", "found"),
    [
        ("3", '"a"', "", ["a", "a", "a"]),
        ("COUNT", "names[i]", '#define COUNT 2\nconst char * names[] = {"a", "b"};', ["a", "b"]),
        ("COUNT", "NAMES[i]", 'enum { COUNT = 2u };\nconst char * NAMES[] = {"a", "b"};', ["a", "b"]),
        ("n", "names[i]", 'unsigned n = 2;\nconst char * names[3] = {"a", "b", "c"};', ["a", "b"]),
    ],
)
def test_what_a_loop_creates(limit: str, topic: str, before: str, found: list[str]) -> None:
    body = LOOP.format(limit=limit, topic=topic, type=INT32)
    assert endpoints(program(body, before)) == [("publisher", name, "std_msgs/msg/Int32") for name in found]
    assert endpoints(program(body.replace("size_t i = 0", "auto i = 0u"), before)) == endpoints(
        program(body, before)
    )
    inclusive = body.replace("<", "<=")
    if topic == '"a"':
        assert len(endpoints(program(inclusive, before))) == len(found) + 1


def test_a_loop_without_a_known_limit_is_marked() -> None:
    body = LOOP.format(limit="argc", topic="names[i]", type=INT32)
    assert any("the topic of the publisher" in reason for reason in reasons(program(body)))
    assert len(endpoints(program(LOOP.format(limit="1000000", topic='"a"', type=INT32)))) == 1


def test_log_macros_select_the_console_and_rosout() -> None:
    text = program('RCUTILS_LOG_INFO_NAMED("n", "text");')
    assert {"+logging_console", "+logging_rosout"} <= set(adopted(text).draft.components)
    assert not any("RCUTILS_LOG_INFO_NAMED" in reason for reason in reasons(text))


def test_floating_point_in_a_log_message_selects_its_component() -> None:
    """Of several calls of one macro, one is enough."""
    plain = 'RCUTILS_LOG_INFO("%d of %s", 1, "two");'
    assert "+logging_float" not in adopted(program(plain)).draft.components
    assert (
        "+logging_float"
        in adopted(program(plain + 'RCUTILS_LOG_INFO("at " "%.2f m", x);' + plain)).draft.components
    )


def test_wide_characters_in_a_log_message_select_their_component() -> None:
    narrow = 'RCUTILS_LOG_INFO("%s %c", "two", 120);'
    assert "+logging_wide" not in adopted(program(narrow)).draft.components
    assert "+logging_wide" in adopted(program('RCUTILS_LOG_INFO("%d %ls", 1, L"two");')).draft.components


def test_a_program_without_a_node_is_taken() -> None:
    """It may ping, or synchronize its clock, and no more."""
    draft = adopted("int main(void) { rmw_uros_ping_agent(100, 1); return 0; }").draft
    assert draft.nodes == ()


def test_queries_of_the_graph_select_their_component() -> None:
    body = """
  rcl_wait_set_init(&set, 0, 1, 0, 0, 0, 0, &context, allocator);
  rcl_wait_set_add_guard_condition(&set, rcl_node_get_graph_guard_condition(&node), NULL);
  rcl_names_and_types_t found = rcl_get_zero_initialized_names_and_types();
  rcl_get_topic_names_and_types(&node, &allocator, false, &found);
"""
    draft = adopted(program(body)).draft
    assert "+graph" in draft.components
    assert {key: value.value for key, value in draft.groups["pools"].items()} == {"guard_conditions": 1}
    assert draft.groups["memory"]["arena"].value == 16384
    assert [remark.text.split()[0] for remark in draft.remarks] == ["rcl_get_topic_names_and_types"]


def test_guard_conditions_of_the_application_have_places() -> None:
    body = "rcl_guard_condition_init(&a, &context, options); rcl_guard_condition_init(&b, &context, options);"
    assert adopted(program(body)).draft.groups["pools"]["guard_conditions"].value == 2
    counts = "rcl_count_publishers(&node, name, &count);"
    draft = adopted(program(counts)).draft
    assert "+graph" in draft.components
    assert not draft.groups.keys() & {"pools", "memory"}


def test_checks_of_a_diagnosis_are_declared(tmp_path: Path) -> None:
    """Each constant once; the tool reads the proposal, and somebody has to write the limits."""
    text = program(
        "(void)rclc_diagnosis_set(DIAGNOSIS_BATTERY, 5);\n"
        "(void)rclc_diagnosis_set((uint8_t)DIAGNOSIS_MOTOR_HEAT, 5);\n"
        "rclc_diagnosis_set(i, 1);\n"
        "while (rclc_diagnosis_level(DIAGNOSIS_BATTERY) == 2u) {}"
    )
    draft = adopted(text).draft
    assert "+diagnosis" in draft.components
    checks = draft.groups["diagnosis"]["checks"]
    assert checks.note == "rclc_diagnosis_set (0.c:5)"
    never = "with `above: {error: 2147483647}` it is never a fault"
    assert reasons(text) == [
        "0.c:7:1: rclc_diagnosis_set: the check `i` is worked out when the program runs",
        f"0.c:5:9: the limits of the check 'battery' are not in these sources: {never}",
        f"0.c:6:7: the limits of the check 'motor_heat' are not in these sources: {never}",
    ]
    base = "version: 1\nprofiles: [pure_sender]\ncomponents: [+diagnosis]\nnodes: [{name: n}]\n"
    planned_file = planned(tmp_path, f"{base}diagnosis: {{checks: {checks.value}}}\n")
    part = planned_file.project.runtime.features.of("diagnosis")
    assert isinstance(part, DiagnosisPlan)
    assert part.declared == ("battery", "motor_heat")


def test_callbacks_of_a_diagnosis_are_declared(tmp_path: Path) -> None:
    """Beside the checks, each once; somebody has to write how long they may take."""
    text = program(
        "(void)rclc_diagnosis_watch((uint8_t)RCLC_CALLBACK_TICK, &timer);\n"
        "(void)rclc_diagnosis_get_callback(RCLC_CALLBACK_TICK, &times);\n"
        "(void)rclc_diagnosis_level(DIAGNOSIS_BATTERY);\n"
        "(void)rclc_diagnosis_watch(i, &timer);"
    )
    draft = adopted(text).draft
    assert "+diagnosis" in draft.components
    group = draft.groups["diagnosis"]
    assert str(group["callbacks"].value) == "[{name: tick}]"
    assert "0.c:5:9: how long the callback 'tick' may take is not in these sources: add `limit`" in reasons(
        text
    )
    assert "0.c:8:7: rclc_diagnosis_watch: the callback `i` is worked out when the program runs" in reasons(
        text
    )
    base = "version: 1\nprofiles: [pure_sender]\ncomponents: [+diagnosis, +executor]\nnodes: [{name: n}]\n"
    keys = ", ".join(f"{key}: {value.value}" for key, value in group.items())
    part = planned(tmp_path, f"{base}diagnosis: {{{keys}}}\n").project.runtime.features.of("diagnosis")
    assert isinstance(part, DiagnosisPlan)
    assert [callback.name for callback in part.callbacks] == ["tick"]


def test_without_calls_of_a_diagnosis_none_is_proposed() -> None:
    assert "diagnosis" not in adopted(program("rclc_other(DIAGNOSIS_BATTERY, 5);")).draft.groups


def test_each_branch_of_a_condition_among_arguments_is_an_endpoint() -> None:
    topic = '#ifdef FILTERED\n  "imu/data"\n#else\n  "imu/data_raw"\n#endif\n'
    text = program(f"rclc_publisher_init_default(&p, &node, {INT32},\n{topic});")
    found = adopted(text).draft.nodes[0].endpoints
    assert [endpoint.name for endpoint in found] == ["imu/data", "imu/data_raw"]
    assert [endpoint.remarks[0].text for endpoint in found] == [
        "only with `#ifdef FILTERED`",
        "only with `#else`",
    ]
    assert reasons(text) == []


def test_the_first_of_two_transports_is_proposed_and_the_other_marked() -> None:
    text = program(
        'rmw_uros_options_set_udp_address("10.0.0.7", "8888", rmw);\n'
        "  rmw_uros_set_custom_transport(true, NULL, o, c, w, r);"
    )
    groups = adopted(text).draft.groups
    assert {key: value.value for key, value in groups["transport"].items()} == {
        "type": "udp",
        "agent": "10.0.0.7:8888",
    }
    (reason,) = reasons(text)
    assert "custom_transport is of the transport custom: `transport.type` has udp (0.c:5)" in reason
