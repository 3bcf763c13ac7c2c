"""What a document must be: valid, and a story that can come to its end.

`schema_errors` and `checker_issues` ask the schemas and the quality checker of ASAM,
`story_problems` looks for what neither of them sees: names that are not unique, references that
lead nowhere, events that can never start, acts that can never end.
"""

import os
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from lxml import etree
from qc_baselib import Configuration, Result, StatusType
from qc_openscenario import constants
from qc_openscenario.main import run_checks

from osc2tx.backends.xosc import XmlScenario
from tests.unit.xosc.schemas import validator

NAMED = ("Story", "Act", "ManeuverGroup", "Maneuver", "Event", "Action", "Condition")
LOCAL = ("ManeuverGroup", "Maneuver", "Action", "Condition")
KINDS = {
    "story": "Story",
    "act": "Act",
    "maneuverGroup": "ManeuverGroup",
    "maneuver": "Maneuver",
    "event": "Event",
    "action": "Action",
}
NEVER_ENDS = ".//*[@continuous='true']", ".//CustomCommandAction"


def schema_errors(xml: str, version: str) -> list[str]:
    """Return what the schema of a version has to say."""
    schema = validator(version)
    schema.validate(etree.fromstring(xml.encode()))
    return [f"{error.line}: {error.message}" for error in schema.error_log]


def checker_issues(xml: str, folder: Path) -> list[str]:
    """Return what the quality checker has to say; it reads files only."""
    path = folder / "checked.xosc"
    path.write_text(xml, encoding="utf-8")
    config, result = Configuration(), Result()
    config.set_config_param("InputFile", str(path.resolve()))
    result.register_checker_bundle(
        name=constants.BUNDLE_NAME, description="", version="", summary=""
    )
    result.set_result_version(version="1")
    here = Path.cwd()
    try:
        run_checks(config, result)  # it changes the working directory
    finally:
        os.chdir(here)
    issues = [
        f"{issue.rule_uid}: {issue.description}"
        for checker in result.get_checker_results(constants.BUNDLE_NAME)
        for issue in checker.issues
    ]
    failed = [
        checker.checker_id
        for checker in result.get_checker_results(constants.BUNDLE_NAME)
        if checker.status == StatusType.ERROR
    ]
    return issues + failed


def untraced(document: XmlScenario) -> list[str]:
    """Return the events of which nobody knows what they stand for."""
    assert document.xml is not None
    events = etree.fromstring(document.xml.encode()).iter("Event")
    return [event.get("name") for event in events if event.get("name") not in document.origins]


def story_problems(xml: str) -> list[str]:
    """Return what is wrong with the story of a document."""
    return Story(etree.fromstring(xml.encode())).problems()


class Story:
    """A document whose elements can be asked whether they can start and end."""

    def __init__(self, root: etree._Element) -> None:
        self.root = root
        self.by_kind = {
            kind: {node.get("name"): node for node in root.iter(tag)} for kind, tag in KINDS.items()
        }
        self.done: set[tuple[str, str | None]] = set()

    def problems(self) -> list[str]:
        return [
            *self._names(),
            *self._references(),
            *self._unreachable(),
            *self._endless(),
        ]

    def _names(self) -> Iterator[str]:
        for tag in NAMED:
            is_local = tag in LOCAL  # and what nobody refers to must differ from its neighbours
            counts = Counter(
                (node.get("name"), node.getparent() if is_local else None)
                for node in self.root.iter(tag)
            )
            yield from (
                f"{count} {tag}s are called {n}" for (n, _), count in counts.items() if count > 1
            )

    def _references(self) -> Iterator[str]:
        entities = {node.get("name") for node in self.root.iter("ScenarioObject")}
        variables = {node.get("name") for node in self.root.iter("VariableDeclaration")}
        parameters = {node.get("name") for node in self.root.iter("ParameterDeclaration")}
        for node in self.root.iter("*"):
            for attribute, known in (
                ("entityRef", entities),
                ("masterEntityRef", entities),
                ("variableRef", variables),
                ("parameterRef", parameters),
            ):
                reference = node.get(attribute)
                if reference is not None and reference not in known:
                    yield f"<{node.tag}> refers to {attribute} {reference}"
            for text in node.attrib.values():
                if (
                    text.startswith("$")
                    and not text.startswith("${")
                    and text[1:] not in parameters
                ):
                    yield f"<{node.tag}> uses the undeclared parameter {text}"
        for node in self.root.iter("StoryboardElementStateCondition"):
            kind, name = node.get("storyboardElementType"), node.get("storyboardElementRef")
            if name not in self.by_kind[kind]:
                yield f"a condition refers to the {kind} {name}"

    def _unreachable(self) -> Iterator[str]:
        """Yield events that cannot start, judging by what else can complete."""
        started: set[str | None] = set()
        acts: set[str | None] = set()
        before = None
        while before != (size := (len(started), len(acts), len(self.done))):
            before = size
            for act in self.root.iter("Act"):
                if self._can_fire(act.find("StartTrigger"), started, acts):
                    acts.add(act.get("name"))
                    self._advance(act, started, acts)
        for act in self.root.iter("Act"):
            if act.get("name") not in acts:
                yield f"act {act.get('name')} can never start"
            for event in act.iter("Event"):
                if act.get("name") in acts and event.get("name") not in started:
                    yield f"event {event.get('name')} waits for ever"

    def _advance(
        self, act: etree._Element, started: set[str | None], acts: set[str | None]
    ) -> None:
        events = list(act.iter("Event"))
        stoppable = self._can_fire(act.find("StopTrigger"), started, acts)
        for event in events:
            if self._can_fire(event.find("StartTrigger"), started, acts):
                started.add(event.get("name"))
                if stoppable or not any(event.xpath(path) for path in NEVER_ENDS):
                    self._complete("event", event)
            elif stoppable:
                self._complete("event", event)
        if stoppable or all(("event", e.get("name")) in self.done for e in events):
            for kind, tag in (("maneuverGroup", "ManeuverGroup"), ("maneuver", "Maneuver")):
                for node in act.iter(tag):
                    self._complete(kind, node)
            self._complete("act", act)

    def _complete(self, kind: str, node: etree._Element) -> None:
        self.done.add((kind, node.get("name")))

    def _can_fire(
        self, trigger: etree._Element | None, started: set[str | None], acts: set[str | None]
    ) -> bool:
        if trigger is None:
            return False
        return any(
            all(self._can_hold(c, started, acts) for c in group.iter("Condition"))
            for group in trigger.iter("ConditionGroup")
        )

    def _can_hold(
        self, condition: etree._Element, started: set[str | None], acts: set[str | None]
    ) -> bool:
        state = condition.find(".//StoryboardElementStateCondition")
        if state is not None:
            kind, name = state.get("storyboardElementType"), state.get("storyboardElementRef")
            if state.get("state") == "standbyState":
                return True
            if state.get("state") == "completeState":
                return (kind, name) in self.done
            return name in (acts if kind == "act" else started)
        variable = condition.find(".//VariableCondition")
        if variable is not None:
            name = variable.get("variableRef")
            return variable.get("value") == "false" or self._can_be_set(
                name, "VariableAction", "variableRef", started
            )
        parameter = condition.find(".//ParameterCondition")
        if parameter is not None:
            name = parameter.get("parameterRef")
            return parameter.get("value") == "false" or self._can_be_set(
                name, "ParameterAction", "parameterRef", started
            )
        return True

    def _can_be_set(
        self, name: str | None, tag: str, attribute: str, started: set[str | None]
    ) -> bool:
        """Whether a started event sets a variable; one that no event sets is set from outside."""
        setters = [
            event.get("name")
            for event in self.root.iter("Event")
            if any(action.get(attribute) == name for action in event.iter(tag))
        ]
        return not setters or any(setter in started for setter in setters)

    def _endless(self) -> Iterator[str]:
        started = {event.get("name") for event in self.root.iter("Event")}
        acts = {act.get("name") for act in self.root.iter("Act")}
        stop = self.root.find("Storyboard/StopTrigger")
        if not self._can_fire(stop, started, acts):
            yield "the storyboard can never stop"
