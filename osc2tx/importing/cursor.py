"""Reads elements and notes what has been used, so that nothing is lost unseen.

A `Node` is an element with the ledger of its document: reading an attribute marks it as used.
What is never read is left out, unless a table says that it changes nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from osc2tx.importing.report import Finding, Grade, ImportReport
from osc2tx.xosc.element import Element, Place, Unresolved

NAMES = "the name has no effect"
TOOLS = "properties are specific to a tool"
LIMITS = "the limits of a vehicle are up to the simulator"
HEADER = "the header describes the file"
LOCATIONS = "catalogs are found by their paths; their entries are in the library files"
AXLES = "no motion here depends on the wheels"

LOOKS = "the look of an actor is up to the simulator"
OBJECTS = ("Vehicle", "Pedestrian", "MiscObject")
NAMED = ("Story", "Act", "ManeuverGroup", "Maneuver", "Event", "Action", "Condition", *OBJECTS)

IDLE: Mapping[tuple[str, str], str] = {
    **{(tag, "name"): NAMES for tag in (*NAMED, "Trajectory", "Route", "Environment", "Weather")},
    **{(tag, "mass"): LIMITS for tag in OBJECTS},
    **{(tag, "model3d"): LOOKS for tag in OBJECTS},
    ("Pedestrian", "model"): LOOKS,
    ("Controller", "name"): NAMES,
    ("Controller", "controllerType"): TOOLS,
}
"""Attributes without effect in the scenario, with the reasons."""

IDLE_ELEMENTS: Mapping[str, str] = {
    "FileHeader": HEADER,
    "CatalogLocations": LOCATIONS,
    "Properties": TOOLS,
    "Performance": LIMITS,
    "Axles": AXLES,
    "SceneGraphFile": "the look of the roads is up to the simulator",
}
"""Elements that have no effect with all below them."""


class Ledger:
    """What of a document has been used.

    Attributes:
        report: Takes what has not.
        used: Elements, and attributes of elements, that are used.
        idle_here: Why attributes change nothing here, even if they were read.
        files: The catalogs that elements are in.
    """

    def __init__(self, report: ImportReport) -> None:
        self.report = report
        self.used: set[tuple[int, str]] = set()
        self.idle_here: dict[tuple[int, str], str] = {}
        self._roots: list[tuple[Element, str]] = []
        self.files: dict[int, str] = {}

    def track(self, root: Element, file: str = "") -> Node:
        """Return a root whose parts all have to be used; `file` if it is in a catalog."""
        self._roots.append((root, file))
        if file:
            self.files.update((id(element), file) for element in root.walk())
        return self.node(root)

    def node(self, element: Element) -> Node:
        """Return an element, which is used with that."""
        self.used.add((id(element), ""))
        return Node(element, self)

    @property
    def entries(self) -> list[tuple[Element, str]]:
        """The entries of catalogs that are tracked, with the names of their files."""
        return [(root, file) for root, file in self._roots if file]

    def close(self) -> None:
        """Report what nobody has used."""
        for root, _ in self._roots:
            self._close(Node(root, self), root.tag)

    def _close(self, node: Node, path: str) -> None:
        element = node.element
        if element.tag in IDLE_ELEMENTS:
            self._idle(node, path, IDLE_ELEMENTS[element.tag])
            return
        if (id(element), "") not in self.used:
            node.leave_out("it is not imported")
            return
        for name, text in element.attributes:
            reason = self.idle_here.get((id(element), name))
            if reason is None and (id(element), name) in self.used:
                continue
            if name == "xmlns" or ":" in name:
                continue
            reason = reason or IDLE.get((element.tag, name))
            if reason is None:
                node.report("left out", f"{name}={text!r} has no counterpart in the DSL")
            else:
                node.note(f"{path}/@{name}", text, reason)
        for child in element.children:
            self._close(Node(child, self), f"{path}/{child.tag}")

    def _idle(self, node: Node, path: str, reason: str) -> None:
        element = node.element
        if not element.attributes and not element.children:
            node.note(path, element.text or "", reason)
        for name, text in element.attributes:
            if (id(element), name) not in self.used:
                node.note(f"{path}/@{name}", text, reason)
        for child in element.children:
            self._idle(Node(child, self), f"{path}/{child.tag}", reason)


class Node:
    """An element whose use is noted.

    Attributes:
        element: The element.
    """

    __slots__ = ("_ledger", "element")

    def __init__(self, element: Element, ledger: Ledger) -> None:
        self.element = element
        self._ledger = ledger

    @property
    def tag(self) -> str:
        """Its name in the document."""
        return self.element.tag

    @property
    def place(self) -> Place | None:
        """Where it begins."""
        return self.element.place

    @property
    def file(self) -> str:
        """The catalog that it is in."""
        return self._ledger.files.get(id(self.element), "")

    def has(self, name: str) -> bool:
        """Whether an attribute is there; that alone does not use it."""
        return self.element.get(name) is not None

    def text(self, name: str) -> str | None:
        """Return the text of an attribute."""
        self._ledger.used.add((id(self.element), name))
        return self.element.get(name)

    def is_true(self, name: str) -> bool:
        """Whether an attribute is true; one that is not there is false."""
        return (self.text(name) or "false").lower() in ("true", "1")

    def said(self, name: str) -> str:
        """Return the text of an attribute, which has to be there.

        Raises:
            Unresolved: It is not.
        """
        self._ledger.used.add((id(self.element), name))
        return self.element.said(name)

    def children(self, *tags: str) -> Iterator[Node]:
        """Yield the children with one of the tags; all of them without tags."""
        for child in self.element.children:
            if not tags or child.tag in tags:
                yield self.other(child)

    def find(self, tag: str) -> Node | None:
        """Return the first child with a tag."""
        return next(self.children(tag), None)

    def one(self, tag: str) -> Node:
        """Return the first child with a tag, which has to be there.

        Raises:
            Unresolved: There is none.
        """
        found = self.find(tag)
        if found is None:
            raise Unresolved(f"<{self.tag}> has no <{tag}>", self.place)
        return found

    def other(self, element: Element) -> Node:
        """Return another element of the document."""
        return self._ledger.node(element)

    @property
    def inner(self) -> Node:
        """The first thing in it.

        Raises:
            Unresolved: There is none.
        """
        return self.other(self.element.inner)

    def entry(self, element: Element, file: str) -> Node:
        """Return an entry of a catalog, of which all parts have to be used."""
        return self._ledger.track(element, file)

    def idle(self, reason: str, *names: str) -> None:
        """Note that attributes change nothing here; all that are there without names."""
        for name, _ in self.element.attributes:
            if not names or name in names:
                self._ledger.idle_here[id(self.element), name] = reason

    def use_all(self) -> None:
        """Note that all of it is used: it was read as a whole, or has been reported."""
        for each in self.element.walk():
            names = ("", *(name for name, _ in each.attributes))
            self._ledger.used.update((id(each), name) for name in names)

    def leave_out(self, reason: str) -> None:
        """Report that nothing says it."""
        self.report("left out", reason)
        self.use_all()

    def approximate(self, reason: str, *, bound: float | None = None) -> None:
        """Report that it is only said nearly; `bound`: by so many metres at most."""
        self.report("approximated", reason, bound)

    def report(self, grade: Grade, reason: str, bound: float | None = None) -> None:
        """Report how well it is said."""
        found = (grade, f"<{self.tag}>", reason, self.place, self.file, bound)
        self._ledger.report.add(Finding(*found))

    def note(self, path: str, text: str, reason: str) -> None:
        """Note that a text in it, at a path, changes nothing."""
        self._ledger.report.note(path, text, reason, self.place, self.file)
