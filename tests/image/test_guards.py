# SPDX-License-Identifier: Apache-2.0
"""What generated encoders and decoders check before a loop or a copy bounds it, and nothing else does."""

from __future__ import annotations

import pytest

from microros_gen.image.guards import OF_BODY, Guards, Written
from microros_gen.image.paths import Length
from microros_gen.image.rounds import Sources

ENCODER = """\
static uint32_t encode(const void * untyped, uint8_t * body, cdr_fault_t * fault)
{
  if (!cdr_fits(message->id.data, message->id.size, 40U, "", fault)) {
    return 0U;
  }
  position = cdr_put_string(body, 8U, message->id.data, message->id.size);
  if (!cdr_fits_bound(
      message->names.data, message->names.size, 8U, 9U, "", fault)) {
    return 0U;
  }
  for (size_t i = 0U; i < message->names.size; ++i) {
    const rosidl_runtime_c__String * const text = &message->names.data[i];
    if (!cdr_fits(text->data, text->size, 20U, "", fault)) {
      return 0U;
    }
    position = cdr_put_string(body, position, text->data, text->size);
  }
  position = cdr_put_sequence_8(
    body, position, message->numbers.data, message->names.size);
  position = cdr_put_packed_4(body, position, message->points.data, message->names.size, 12U);
  cdr_put_array_2(&body[position], message->fixed, 9U);
  return position;
}
"""


def line_of(text: str, source: str = ENCODER) -> int:
    return source[: source.index(text)].count("\n") + 1


def test_what_is_written_follows_from_the_checks_before_it() -> None:
    guards = Guards(ENCODER)
    for text, written in (
        ("cdr_put_string(body, 8U", Written("cdr_put_string", 40, 40)),
        ("cdr_put_string(body, position", Written("cdr_put_string", 20, 20)),
        ("cdr_put_sequence_8", Written("cdr_put_sequence_8", 8, 64)),
        ("body, position, message->numbers", Written("cdr_put_sequence_8", 8, 64)),
        ("cdr_put_packed_4", Written("cdr_put_packed_4", 8, 96)),
        ("cdr_put_array_2", Written("cdr_put_array_2", 9, 18)),
        ("return position", None),
    ):
        assert guards.written(line_of(text)) == written, text
    assert guards.limit("message->names.size", line_of("for (size_t")) == 8
    assert guards.largest("cdr_put_string") == Written("cdr_put_string", 40, 40)
    assert guards.largest("cdr_copy") == Written("cdr_copy", 40, 96), "others call it, too"
    assert guards.largest("cdr_put_wstring") is None


def test_the_most_elements_need_not_have_the_most_bytes() -> None:
    """A function that others call, as cdr_put_array_bool, has a round for each element, of whatever width."""
    source = "{\n  cdr_put_array_8(body, message->doubles, 10U);\n  cdr_put_array_bool(body, message->flags, 70U);\n}\n"
    assert Guards(source).largest("cdr_put_array_bool") == Written("cdr_put_array_bool", 70, 80)


@pytest.mark.parametrize(
    ("was", "now"),
    [
        ('40U, "", fault', 'limit, "", fault'),
        ("message->id.size, 40U", "message->other.size, 40U"),
        ("return 0U;\n  }\n  position = cdr_put_string(body, 8U", "}\n  position = cdr_put_string(body, 8U"),
        ("  if (!cdr_fits(message->id", "  if (more) {\n  if (!cdr_fits(message->id"),
    ],
    ids=["no number", "of something else", "refuses nothing", "in a branch"],
)
def test_a_check_that_may_not_have_been_made_bounds_nothing(was: str, now: str) -> None:
    source = ENCODER.replace(was, now, 1)
    if "more" in now:
        source = source.replace(
            "  position = cdr_put_string(body, 8U", "  }\n  position = cdr_put_string(body, 8U"
        )
    assert source != ENCODER
    guards = Guards(source)
    assert guards.written(line_of("cdr_put_string(body, 8U", source)) is None
    assert guards.largest("cdr_put_string") is None, "one of its calls has no bound"
    assert guards.largest("cdr_copy") is None


def test_a_loop_of_a_decoder_is_bounded_by_the_bytes_of_the_message() -> None:
    decoder = """\
void decode(cdr_in_t * in, void * untyped)
{
  cdr_get_size(in, &message->names, CDR_UNBOUNDED, "");
  for (size_t i = 0U; i < message->names.size; ++i) {
    work(in);
  }
  for (size_t i = 0U; i < message->others.size; ++i) {
    work(in);
  }
}
"""
    assert Guards(decoder).limit("message->names.size", 4) == OF_BODY
    constants = "#define MICROROS_INPUT_BUFFER_SIZE 64u\n#define MICROROS_QUEUES_SIZE 100u\n"
    sources = Sources(lambda _: decoder, [constants])
    assert sources.rounds([("a.c", 5)]) == Length(164)
    assert sources.rounds([("a.c", 8)]) == "a.c:7"


def test_a_loop_of_an_encoder_has_the_rounds_that_it_checks() -> None:
    sources = Sources(lambda _: ENCODER, [])
    assert sources.rounds([("a.c", line_of("return 0U;\n    }"))]) == Length(8)
    changed = ENCODER.replace(
        "position, text->data, text->size);", "position, text->data, text->size);\n    i = 0U;"
    )
    assert (
        Sources(lambda _: changed, []).rounds([("a.c", line_of("return 0U;\n    }"))])
        == f"a.c:{line_of('for (')}"
    )


def test_an_inlined_call_is_that_of_the_source_which_calls_it() -> None:
    sources = Sources(lambda _: ENCODER, [])
    header = "include/microros/cdr.h"
    calls = [(header, 293), ("src/a/a__type_support.c", line_of("cdr_put_sequence_8")), ("src/b.c", 1)]
    assert sources.written(calls, "encode", "src/a/a__type_support.c") == Written("cdr_put_sequence_8", 8, 64)
    own = sources.written(calls[:1], "cdr_put_packed_4.part.0", "src/a/a__type_support.c")
    assert own == Written("cdr_put_packed_4", 8, 96)
