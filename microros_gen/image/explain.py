# SPDX-License-Identifier: Apache-2.0
"""Why something is in an image: where it comes from, who refers to it, who chose it, what would remove it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from microros_gen.application.kinds import RECEIVING
from microros_gen.diagnostics import Diagnostic, UserError, nearest
from microros_gen.image.attribution import Chunk, attribute_library
from microros_gen.image.entities import messages_of, shown_endpoint, with_parts
from microros_gen.image.folder import Folder
from microros_gen.image.references import References, read_references
from microros_gen.image.report import SizeReport
from microros_gen.image.stack import shown_name
from microros_gen.records import dataclass
from microros_gen.selection.component import Catalogue

_NEEDED_BY = "needed by "
_ERROR = re.compile(r'^#error\s+"?(.*?)"?\s*$', re.MULTILINE)
_LISTED = 12
_OTHERS = ("application", "other library", "start-up", "compiler", "C library")


@dataclass(frozen=True)
class Explanation:
    """What is known of one thing. `kind` is symbol, file, component or type.

    `chain` is a way of references from the program's start to it; `reasons` are the manifest's; `removes` says what
    in the application file would take it away, all of it together; each of `choices` does so alone; `holds` lists
    what it is made of, with bytes.
    """

    kind: str
    name: str
    of: str
    place: str
    flash: int
    ram: int
    present: bool
    note: str = ""
    reasons: tuple[str, ...] = ()
    chain: tuple[str, ...] = ()
    entities: tuple[str, ...] = ()
    removes: tuple[str, ...] = ()
    choices: tuple[str, ...] = ()
    holds: tuple[tuple[str, int], ...] = ()


class Explainer:
    """Answers questions about one output folder. `sources_of` gives the C text of a component's files."""

    def __init__(
        self, report: SizeReport, catalogue: Catalogue, sources_of: Callable[[str], Iterable[bytes]]
    ) -> None:
        self._report = report
        self._folder: Folder = report.folder
        self._catalogue = catalogue
        self._sources_of = sources_of
        self._references: References | None = None

    def explain(self, query: str) -> Explanation:
        """Return what is known of a symbol (also by a unique beginning), file, component or type.

        Raises UserError with the nearest name where nothing has that name.
        """
        for answer in (self._component, self._type, self._file, self._own, self._symbol, self._absent):
            found = answer(query)
            if found is not None:
                return found
        known = {*self._names(), *self._folder.components, *self._catalogue, *self._folder.manifest["types"]}
        known |= {name.rpartition("/")[2] for name in self._folder.manifest["outputs"]}
        beginning = sorted(name for name in self._names() if name.startswith(query))
        hint = f"It may be {', '.join(beginning[:6])}" if beginning else nearest(query, known)
        raise UserError(
            [
                Diagnostic(
                    f"{self._folder.path} has no symbol, file, component or type '{query}'",
                    hint=hint or f"`microros-gen size {self._folder.path} --all` lists the symbols",
                    id="MG-8403",
                )
            ]
        )

    def _component(self, query: str) -> Explanation | None:
        if query in self._folder.components:
            chunks = [
                p for p in self._report.chunks if p.owner.name == query and p.owner.group == "component"
            ]
            component = self._catalogue.get(query)
            note = component.summary if component else self._outside(query)
            return self._of_chunks("component", query, chunks, note)
        if query in self._catalogue:
            return self._unselected(query, query)
        return None

    def _outside(self, name: str) -> str:
        """Return what the manifest says of a component that does not ship with the tool."""
        found = self._folder.manifest["selection"].get("outside", {}).get(name)
        return f"{found['summary']} (from {found['from']})" if found else ""

    def _type(self, query: str) -> Explanation | None:
        if query not in self._folder.manifest["types"]:
            return None
        chunks = [p for p in self._report.chunks if p.owner.group == "type support" and p.owner.name == query]
        return self._of_chunks("type", query, chunks, "")

    def _file(self, query: str) -> Explanation | None:
        names = [*self._folder.manifest["outputs"]]
        exact = [n for n in names if n == query or n == f"include/{query}"]
        found = exact or sorted(n for n in names if n.rpartition("/")[2] == query)
        if not found:
            return None
        if len(found) > 1:
            hint = f"Choose one: {', '.join(found)}"
            raise UserError([Diagnostic(f"{len(found)} files are named {query}", hint=hint, id="MG-8404")])
        name = found[0]
        text = (self._folder.path / name).read_text(encoding="utf-8", errors="replace")
        refusal = _ERROR.search(text) if name.endswith(".h") else None
        if refusal and text.count("\n") < 20:
            return Explanation("file", name, "", name, 0, 0, False, f"Including it is an error: {refusal[1]}")
        chunks = [p for p in self._report.chunks if p.source == name]
        return self._of_chunks("file", name, chunks, self._header_note(name))

    def _own(self, query: str) -> Explanation | None:
        """Explain an object or archive that is not the library's: `app.c`, `app.c.o`, `libdriver.a`."""
        names = (query, f"{query}.o", f"{query}.obj")
        chunks = [p for p in self._report.chunks if p.owner.group in _OTHERS and p.owner.name in names]
        return self._of_chunks("file", query, chunks, chunks[0].owner.group) if chunks else None

    def _symbol(self, query: str) -> Explanation | None:
        names = self._names()
        exact = [n for n in names if n == query]
        found = exact or sorted(n for n in names if n.startswith(query))
        if len(found) != 1:
            return None
        chunks = names[found[0]]
        chunk = chunks[0]
        answer = self._of_chunks("symbol", found[0], chunks, "")
        place = self._report.facts.places.get(chunk.address)
        where = chunk.source or ""
        if place is not None and place.line:
            where = f"{self._folder.shown_file(place.file)}:{place.line}"
        return _with_place(answer, where)

    def _absent(self, query: str) -> Explanation | None:
        """Explain a symbol that the linker dropped, or that a component brings that is not selected."""
        if self._folder.image:
            for chunk in attribute_library(self._folder):
                if chunk.symbol and shown_name(chunk.symbol) == query:
                    note = "It is in the library, and the linker left it out: nothing that runs refers to it"
                    name, source = chunk.owner.name, chunk.source or ""
                    reasons = tuple(self._folder.manifest["selection"]["reasons"].get(name, ()))
                    return Explanation("symbol", query, name, source, 0, 0, False, note, reasons)
        word = re.compile(rb"^[^\s#/].*\b" + re.escape(query.encode()) + rb"\(", re.MULTILINE)
        for name in sorted(set(self._catalogue) - set(self._folder.components)):
            if any(word.search(text) for text in self._sources_of(name)):
                return self._unselected(name, query)
        return None

    def _unselected(self, component: str, query: str) -> Explanation:
        kind = "component" if query == component else "symbol"
        known = self._catalogue[component]
        state = "" if known.ready else " It is planned: a build names it as missing."
        note = (
            f"Not selected. `components: [+{component}]` in microros.yaml adds it ({known.summary}).{state}"
        )
        return Explanation(kind, query, component, "", 0, 0, False, note)

    def _of_chunks(self, kind: str, name: str, chunks: list[Chunk], note: str) -> Explanation:
        owner = self._owner_of(kind, name, chunks)
        flash, ram = sum(p.flash for p in chunks), sum(p.ram for p in chunks)
        reasons = tuple(self._folder.manifest["selection"]["reasons"].get(owner, ()))
        if (
            not chunks
            and kind in ("component", "file", "type")
            and self._folder.image
            and not note.endswith("header")
        ):
            left = "nothing of it is in the image: the linker left out what nobody refers to, or it has headers only"
            note = f"{note}; {left}" if note else left
        source = chunks[0].source or "" if kind in ("symbol", "file") and chunks else ""
        return Explanation(
            kind,
            name,
            owner,
            source,
            flash,
            ram,
            bool(chunks),
            note,
            reasons,
            self._chain(chunks),
            tuple(self._entities(owner)),
            tuple(dict.fromkeys(self._removes(owner))),
            tuple(dict.fromkeys(self._file_choice(chunks, kind))),
            _holds(chunks) if kind != "symbol" else (),
        )

    def _owner_of(self, kind: str, name: str, chunks: list[Chunk]) -> str:
        if chunks:
            return chunks[0].owner.name
        if kind == "file":
            parts = name.split("/")
            by_header = [
                c.name for c in self._catalogue.values() if name.removeprefix("include/") in c.headers
            ]
            return (
                by_header[0]
                if by_header
                else self._folder.types.get(name, parts[1] if len(parts) > 2 else "")
            )
        return name

    def _header_note(self, name: str) -> str:
        return "a header" if name.endswith(".h") else ""

    def _chain(self, chunks: Iterable[Chunk]) -> tuple[str, ...]:
        if not self._folder.image:
            return ()
        if self._references is None:
            self._references = read_references(self._folder, self._report.chunks)
        stack = self._report.stack
        roots = ("main", *(b.name for b in (stack.main, *stack.handlers) if b))
        chains = [
            self._references.chain((p.source, p.symbol), roots)
            for p in sorted(chunks, key=lambda p: (-p.size, p.address))
            if p.symbol and p.source and not p.symbol.startswith('"')
        ]
        found = min((c for c in chains if c), key=len, default=())
        return tuple(shown_name(name) for name in found)

    def _names(self) -> dict[str, list[Chunk]]:
        """Return the named pieces of the image by the name that the application writes."""
        found: dict[str, list[Chunk]] = {}
        for chunk in self._report.chunks:
            for name in (chunk.symbol, *chunk.aliases):
                if name and not name.startswith('"'):
                    found.setdefault(shown_name(name), []).append(chunk)
        return found

    def _entities(self, owner: str) -> Iterator[str]:
        """Yield the entities that need what belongs to `owner`; nothing where the whole session does."""
        manifest = self._folder.manifest
        publishers, types = manifest["entities"]["publishers"], manifest["types"]
        for publisher in publishers:
            kind = publisher["type"]
            fits = {
                "publish": True,
                "stream_reliable": publisher["reliable"],
                "stream_best_effort": not publisher["reliable"],
            }.get(owner, owner == kind or owner in types[kind]["parts"])
            if fits:
                yield f"publisher {publisher['topic']} ({kind})"
        yield from self._receiving(owner)
        if owner == "node":
            yield from (f"node {n['name']}" for n in manifest["entities"]["nodes"])

    def _receiving(self, owner: str) -> Iterator[str]:
        manifest = self._folder.manifest
        for kind in RECEIVING:
            for entity in manifest["entities"].get(kind.key, ()):
                if owner == kind.component or owner in with_parts(
                    messages_of(entity["type"], manifest), manifest
                ):
                    yield f"{kind.name} {shown_endpoint(entity)} ({entity['type']})"

    def _removes(self, owner: str, seen: frozenset[str] = frozenset()) -> Iterator[str]:
        reasons = self._folder.manifest["selection"]["reasons"]
        if owner in self._folder.manifest["types"]:
            yield f"removing what uses {owner} from `nodes:` or `interfaces:`"
        for reason in reasons.get(owner, ()):
            if reason.startswith(_NEEDED_BY):
                name = reason.removeprefix(_NEEDED_BY)
                if name not in seen:
                    yield from self._removes(name, seen | {owner})
            else:
                yield _change(reason, owner)

    def _file_choice(self, chunks: Iterable[Chunk], kind: str) -> Iterator[str]:
        """Yield the alternatives to a file that one choice of the plan selects."""
        sources = sorted({p.source for p in chunks if p.source}) if kind in ("file", "symbol") else ()
        for source in sources:
            component = self._catalogue.get(source.split("/")[1]) if source.count("/") > 1 else None
            for file in component.files if component else ():
                if file.path.removesuffix(".j2") == source.rpartition("/")[2] and file.when:
                    wanted = ", ".join(f"{key} = {value}" for key, value in file.when)
                    yield f"another choice of {wanted}: this file implements it"


def _change(reason: str, owner: str) -> str:
    """Return what a user changes to take a reason away."""
    if reason.startswith("profile "):
        return f"another profile than {reason.removeprefix('profile ')}"
    if reason.startswith("components: "):
        return f"`{reason}` taken out"
    for axis, others in (
        ("liveliness: ping", "liveliness: acknack, or none"),
        ("liveliness: ", "another `liveliness:`"),
        ("entities: ", "another `entities:` (preconfigured has no code for it)"),
        ("transport: ", "another `transport: {type: …}`"),
        ("target: ", "another target"),
        ("a reliable publisher", "`qos: {reliability: best_effort}`, or no such publisher"),
        ("a best effort publisher", "`qos: {reliability: reliable}`, or no such publisher"),
    ):
        if reason.startswith(axis):
            return f"{others} (now: {reason})"
    return f"a change of: {reason}" if reason else f"leaving out {owner}"


def _holds(chunks: Iterable[Chunk]) -> tuple[tuple[str, int], ...]:
    sizes: dict[str, int] = {}
    for chunk in chunks:
        name = shown_name(chunk.symbol) if chunk.symbol else f"({chunk.input or chunk.section})"
        sizes[name] = sizes.get(name, 0) + chunk.size
    return tuple(sorted(sizes.items(), key=lambda s: (-s[1], s[0]))[:_LISTED])


def _with_place(answer: Explanation, place: str) -> Explanation:

    return replace(answer, place=place)
