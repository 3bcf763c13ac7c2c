"""The tools: functions from texts to plain data.

A scenario is given as a text and checked as if it were a file of the working folder: it may import
the files there. Nothing is written without an output folder, and nothing outside it.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from typing import Any, Literal, TypeAlias

from osc2tx.api import apply_fixes, compile_text
from osc2tx.building.jobs import Job, job_of_text
from osc2tx.building.write import replace_file
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.config import GivenOptions
from osc2tx.diagnostics import Severity
from osc2tx.diagnostics.codes import find_code
from osc2tx.diagnostics.render import explanation_data, render_json
from osc2tx.diagnostics.report import make_report
from osc2tx.diagnostics.suggestions import did_you_mean
from osc2tx.importing.document import Refused
from osc2tx.importing.importer import import_document
from osc2tx.importing.libraries import Library
from osc2tx.module_loading import scenarios_of_module
from osc2tx.reference import as_text, entries, find, find_topics, topic_as_text, topics
from osc2tx.version import __version__
from osc2tx_runtime import Scenario, ScenarioError, run_scenario
from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.report.tree_pictures import tree_svg, tree_text
from osc2tx_runtime.running.main import choose_scenario
from osc2tx_runtime.running.options import read_options
from osc2tx_shared.classes import replace

Answer: TypeAlias = dict[str, Any]
Fixes: TypeAlias = Literal["none", "safe", "all"]

LONGEST_RUN = 600.0  # simulated seconds, which a caller may not exceed
SHOWN_KINDS = ("event", "collision", "action")  # of lines of a trace, besides the last states


class CannotAnswer(Exception):
    """A call of a tool has no answer; the message states why."""


class Answers:
    """The tools, over one folder.

    Attributes:
        folder: Folder of imported files and settings.
        out: Folder of the outputs; `None` to write nothing.
    """

    def __init__(self, folder: Path, out: Path | None = None) -> None:
        """Take the folders."""
        self.folder = folder
        self.out = out

    def check(self, text: str, name: str, fix: Fixes = "none") -> Answer:
        """Return the diagnostics of a scenario, and its text after fixes if they are requested."""
        self._within(name)
        answer: Answer = {}
        if fix != "none":
            text = apply_fixes(text, unsafe=fix == "all", name=name, folder=self.folder)
            answer["text"] = text
        job = self._job(name)
        return answer | _diagnostics(job, text)

    def build(self, text: str, name: str) -> Answer:
        """Return the module and the XML of a scenario; write them if there is a folder."""
        self._within(name)
        answer = _diagnostics(self._job(name), text)
        result = compile_text(text, name=name, folder=self.folder)
        answer["levels"] = dict(result.levels)
        answer["outputs"] = {n: t for n, t in result.outputs.items() if not n.endswith(".map.json")}
        if self.out is not None:
            answer["written"] = self._write(result.outputs)
        return answer

    def run(self, text: str, name: str, scenario: str | None, seed: int, max_time: float) -> Answer:
        """Run a scenario in the embedded world; return its verdict, actions and collisions."""
        with self._scenarios(text, name, scenario) as chosen:
            stated = read_options(dict(self._job(name).run), is_trusted=False)
            folders = (*stated.map_path, self.folder / Path(name).parent)
            longest = min(max_time, LONGEST_RUN)
            settings = replace(stated, seed=seed, max_time=longest, map_path=folders)
            result = run_scenario(chosen, settings)
        lines = [json.loads(line) for line in result.trace_lines]
        last = {line["actor"]: line for line in lines if line["kind"] == "state"}
        return {
            "status": result.status,
            "reason": result.reason,
            "time": result.time,
            "place": result.place,
            "warnings": list(result.warnings),
            "trace": [line for line in lines if line["kind"] in SHOWN_KINDS],
            "last_states": list(last.values()),
        }

    def tree(self, text: str, name: str, scenario: str | None, form: str) -> str:
        """Return the behavior tree of a scenario, as text or SVG."""
        with self._scenarios(text, name, scenario) as chosen:
            root = chosen().create_tree()
            return tree_svg(root) if form == "svg" else tree_text(root)

    def import_xml(self, document: str, name: str) -> Answer:
        """Return the scenario of an OpenSCENARIO XML document, with a report on what it lacks."""
        try:
            found = import_document(document.encode(), f"{name}.xosc", Library(), name=name)
        except Refused as error:
            raise CannotAnswer(f"{error.place or name}: {error.reason}") from None
        file = f"{found.name}.osc"
        text = self._job(file).compilation(text=found.text).formatted or found.text
        answer: Answer = {"name": found.name, "text": text}
        answer["report"] = json.loads(found.report.to_json())
        if self.out is not None:
            answer["written"] = self._write({file: text})
        return answer

    def _job(self, name: str) -> Job:
        return job_of_text(name, self.folder, GivenOptions())

    @staticmethod
    def _within(name: str) -> None:
        path = PurePosixPath(name.replace("\\", "/"))
        if path.is_absolute() or ".." in path.parts or path.suffix != ".osc":
            raise CannotAnswer(f"`{name}`: write the name of an .osc file below the folder")

    def _write(self, outputs: Any) -> list[str]:
        assert self.out is not None
        for file, content in outputs.items():
            place = self.out / file
            place.parent.mkdir(parents=True, exist_ok=True)
            replace_file(place, content.encode())
        return sorted(outputs)

    @contextmanager
    def _scenarios(self, text: str, name: str, wanted: str | None) -> Iterator[type[Scenario]]:
        self._within(name)
        compilation = self._job(name).compilation(text=text)
        if compilation.module is None:
            errors = [f for f in compilation.diagnostics if f.severity is Severity.ERROR]
            reasons = [f"{each.primary}: {each.code}: {each.message}" for each in errors]
            raise CannotAnswer("\n".join(reasons) or f"{name} declares no scenario")
        try:
            with scenarios_of_module(compilation.module, sibling_modules(compilation)) as found:
                yield choose_scenario(tuple(found.values()), wanted)
        except ScenarioError as error:
            raise CannotAnswer(error.report(name)) from None
        except SettingsError as error:
            raise CannotAnswer(error.message) from None


def _diagnostics(job: Job, text: str) -> Answer:
    """Return the diagnostics in the form of `--output-format json`."""
    compilation = job.compilation(text=text)
    compilation.check()
    report = make_report(compilation.diagnostics, files=1)
    report = replace(report, scenarios=tuple(compilation.scenarios))
    found = json.loads(render_json(report, version=__version__))
    return {"ok": report.errors == 0, **{k: found[k] for k in ("diagnostics", "scenarios")}}


def explain(code: str) -> Answer:
    """Return the documentation of a diagnostic code."""
    found = find_code(code)
    if found is None:
        raise CannotAnswer(f"there is no code `{code}`")
    return dict(explanation_data(found))


def reference(name: str | None) -> str:
    """Return the page of a name of the library or of the language; all names without one."""
    if not name:
        words = (f"{topic.kind} {topic.name}" for topic in topics() if topic.is_of_language)
        return "\n".join([*(each.key for each in entries()), *words])
    found = [*map(as_text, find(name)), *map(topic_as_text, find_topics(name))]
    if not found:
        known = [each.declaration.name for each in entries()]
        meant = did_you_mean(name, [*known, *(n for topic in topics() for n in topic.names)])
        raise CannotAnswer(f"there is no `{name}`" + (f"; {meant}" if meant else ""))
    return "\n\n\n".join(found)
