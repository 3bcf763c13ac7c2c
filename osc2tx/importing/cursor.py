"""Reads elements and notes what has been used, so that nothing is lost unseen.

A `Node` is an element with the ledger of its document: reading an attribute marks it as used.
What is never read is left out, unless a table says that it changes nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from osc2tx.importing.report import ImportReport
from osc2tx.xosc.element import Element, Place, Unresolved

NAMES = "the name has no effect"
TOOLS = "properties are specific to a tool"
LIMITS = "the limits of a vehicle are up to the simulator"
HEADER = "the header describes the file"
LOCATIONS = "catalogs are found by their paths; their entries are in the library files"
AXLES = "no motion here depends on the wheels"

IDLE: Mapping[tuple[str, str], str] = {
    ("Action", "name"): NAMES,
    ("Condition", "name"): NAMES,
    ("ManeuverGroup", "name"): NAMES,
    ("Maneuver", "name"): NAMES,
    ("Act", "name"): NAMES,
    ("Story", "name"): NAMES,
    ("Event", "name"): NAMES,
    ("Trajectory", "name"): NAMES,
    ("Vehicle", "name"): NAMES,
    ("Pedestrian", "name"): NAMES,
    ("MiscObject", "name"): NAMES,
    ("Route", "name"): NAMES,
    ("Controller", "name"): NAMES,
    ("Controller", "controllerType"): TOOLS,
    ("Environment", "name"): NAMES,
    ("Weather", "name"): NAMES,
    ("Vehicle", "mass"): LIMITS,
    ("Pedestrian", "mass"): LIMITS,
    ("MiscObject", "mass"): LIMITS,
    ("Pedestrian", "model"): "the look of an actor is up to the simulator",
    ("Vehicle", "model3d"): "the look of an actor is up to the simulator",
    ("Pedestrian", "model3d"): "the look of an actor is up to the simulator",
    ("MiscObject", "model3d"): "the look of an actor is up to the simulator",
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
    """

    def __init__(self, report: ImportReport) -> None:
        self.report = report
        self._used: set[tuple[int, str]] = set()
        self._idle_here: dict[tuple[int, str], str] = {}
        self._roots: list[tuple[Element, str]] = []
        self._files: dict[int, str] = {}
        self._noted: set[tuple[str, str, str, str]] = set()

    def track(self, root: Element, file: str = "") -> Node:
        """Return a root whose parts all have to be used; `file` if it is in a catalog."""
        self._roots.append((root, file))
        if file:
            self._files.update((id(element), file) for element in root.walk())
        return Node(root, self)

    @property
    def entries(self) -> list[tuple[Element, str]]:
        """The entries of catalogs that are tracked, with the names of their files."""
        return [(root, file) for root, file in self._roots if file]

    def use(self, element: Element, name: str = "") -> None:
        """Note that an element is used, or one of its attributes."""
        self._used.add((id(element), name))

    def use_all(self, element: Element) -> None:
        """Note that all of an element is used."""
        for each in element.walk():
            here = id(each)
            self._used.add((here, ""))
            self._used.update([(here, name) for name, _ in each.attributes])

    def set_idle(self, element: Element, name: str, reason: str) -> None:
        """Note that an attribute changes nothing here, even if it was read."""
        self._idle_here[id(element), name] = reason

    def file_of(self, element: Element) -> str:
        """Return the catalog that an element is in."""
        return self._files.get(id(element), "")

    def close(self) -> None:
        """Report what nobody has used."""
        for root, file in self._roots:
            self._close(root, root.tag, file)

    def _close(self, element: Element, path: str, file: str) -> None:
        if element.tag in IDLE_ELEMENTS:
            self._idle(element, path, IDLE_ELEMENTS[element.tag], file)
            return
        if (id(element), "") not in self._used:
            self.report.add(
                "left out", f"<{element.tag}>", "it is not imported", element.place, file=file
            )
            return
        for name, text in element.attributes:
            reason = self._idle_here.get((id(element), name))
            if reason is None and (id(element), name) in self._used:
                continue
            if name == "xmlns" or ":" in name:
                continue
            reason = reason or IDLE.get((element.tag, name))
            if reason is None:
                said = f"{name}={text!r} has no counterpart in the DSL"
                self.report.add("left out", f"<{element.tag}>", said, element.place, file=file)
            else:
                self._note(path, name, text, reason, element.place, file)
        for child in element.children:
            self._close(child, f"{path}/{child.tag}", file)

    def _idle(self, element: Element, path: str, reason: str, file: str) -> None:
        if not element.attributes and not element.children:
            self._note(path, "", element.text or "", reason, element.place, file)
        for name, text in element.attributes:
            if (id(element), name) not in self._used:
                self._note(path, name, text, reason, element.place, file)
        for child in element.children:
            self._idle(child, f"{path}/{child.tag}", reason, file)

    def _note(
        self, path: str, name: str, text: str, reason: str, place: Place | None, file: str
    ) -> None:
        at = ":".join(str(part) for part in (file, place) if part)
        said = (f"{path}/@{name}" if name else path, text, reason, at)
        if said not in self._noted:
            self._noted.add(said)
            self.report.idle.append(said)


class Node:
    """An element whose use is noted.

    Attributes:
        element: The element.
    """

    __slots__ = ("_ledger", "element")

    def __init__(self, element: Element, ledger: Ledger) -> None:
        self.element = element
        self._ledger = ledger
        ledger.use(element)

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
        return self._ledger.file_of(self.element)

    def has(self, name: str) -> bool:
        """Whether an attribute is there; that alone does not use it."""
        return self.element.get(name) is not None

    def text(self, name: str) -> str | None:
        """Return the text of an attribute."""
        self._ledger.use(self.element, name)
        return self.element.get(name)

    def said(self, name: str) -> str:
        """Return the text of an attribute, which has to be there.

        Raises:
            Unresolved: It is not.
        """
        self._ledger.use(self.element, name)
        return self.element.said(name)

    def children(self, *tags: str) -> Iterator[Node]:
        """Yield the children with one of the tags; all of them without tags."""
        for child in self.element.children:
            if not tags or child.tag in tags:
                yield Node(child, self._ledger)

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
        return Node(element, self._ledger)

    @property
    def inner(self) -> Node:
        """The first thing in it.

        Raises:
            Unresolved: There is none.
        """
        return Node(self.element.inner, self._ledger)

    def entry(self, element: Element, file: str) -> Node:
        """Return an entry of a catalog, of which all parts have to be used."""
        return self._ledger.track(element, file)

    def idle(self, reason: str, *names: str) -> None:
        """Note that attributes change nothing here; all that are there without names."""
        for name, _ in self.element.attributes:
            if not names or name in names:
                self._ledger.set_idle(self.element, name, reason)

    def use_all(self) -> None:
        """Note that all of it is used: it was read as a whole, or has been reported."""
        self._ledger.use_all(self.element)

    def leave_out(self, reason: str) -> None:
        """Report that nothing says it."""
        self._grade("left out", reason)
        self.use_all()

    def approximate(self, reason: str, *, bound: float | None = None) -> None:
        """Report that it is only said nearly; `bound`: by so many metres at most."""
        self._grade("approximated", reason, bound)

    def _grade(self, grade: str, reason: str, bound: float | None = None) -> None:
        self._ledger.report.add(
            "left out" if grade == "left out" else "approximated",
            f"<{self.tag}>",
            reason,
            self.place,
            file=self.file,
            bound=bound,
        )
