"""Public scenarios that build also run: each ends in a verdict, none in a traceback.

Also those run whose authors expect a refusal, if they build. Where a scenario is for a map that
nobody has published, the highway of the runtime stands in under its name; then much goes wrong, and
has to be said properly.
"""

import importlib.util
import json
import re
import shutil
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from types import ModuleType

import pytest

import osc2tx_runtime
from osc2tx_runtime import Scenario, main
from tests.corpus.report import compilation_of, manifest

MAX_TIME = 20.0  # s of simulated time
EXTERNAL = "math.sin"  # the only function that scenarios of the corpus call
MAPS = ("carla-2020", "carla-2019", "esmini")
OPEN = r"the scenario leaves (\S+) open: give it a value"
STAND_IN = Path(osc2tx_runtime.__file__).parent / "maps" / "highway.xodr"
VARIANTS = (
    ("--seed=0",),
    ("--seed=1", "--dt=0.1"),
    ("--seed=2", "--dt=0.02"),
)
# What `main` returns of a scenario: succeeded, failed or ran out of time, cannot be read (no such
# map). Wrong usage (2) would be a mistake of this test.
VERDICTS = {0: "success", 4: "unreadable", 5: "failed"}


@dataclass(frozen=True)
class Ended:
    """How a run ended.

    Attributes:
        file: In the corpus.
        scenario: Of the file.
        variant: Options of the run.
        verdict: One of `VERDICTS`, or what went wrong.
        said: What was written to the console.
        trace: Lines of the trace; none if the run did not begin.
    """

    file: str
    scenario: str
    variant: tuple[str, ...]
    verdict: str
    said: str
    trace: tuple[str, ...]


def load(path: Path, name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def own_scenarios(module: ModuleType) -> list[type[Scenario]]:
    """Return those that one may run by themselves, as `main` of the module has them."""
    classes = [each for each in vars(module).values() if isinstance(each, type)]
    own = [each for each in classes if issubclass(each, Scenario) and not each.is_abstract()]
    return [each for each in own if "." not in each.name]


def modules(corpus: Path, folder: Path) -> Iterator[tuple[str, ModuleType]]:
    """Build all of the corpus, and import what can be built."""
    patch = pytest.MonkeyPatch()
    for number, row in enumerate(manifest(corpus)):
        module = compilation_of(corpus, row).module
        if module is None:
            continue
        path = folder / f"m{number}" / f"{module.stem}.py"
        path.parent.mkdir()
        path.write_text(module.python, encoding="utf-8")
        path.with_suffix(".map.json").write_text(module.source_map, encoding="utf-8")
        patch.syspath_prepend(path.parent)
        yield row["file"], load(path, f"corpus_{number}")
        del sys.modules[f"corpus_{number}"]
    patch.undo()


class Runs:
    """Runs scenarios as a user does, and keeps what they said."""

    def __init__(self, data: Path, folder: Path) -> None:
        self.trace = folder / "trace.jsonl"
        self.stand_ins = folder / "maps"
        self.stand_ins.mkdir()
        places = [*(data / "maps" / name for name in MAPS), self.stand_ins]
        self.maps = [f"--map-path={place}" for place in places]

    def end(self, file: str, scenario: type[Scenario], variant: tuple[str, ...]) -> Ended:
        self.trace.unlink(missing_ok=True)
        options = [
            f"--max-time={MAX_TIME}",
            f"--trace={self.trace}",
            f"--allow-external={EXTERNAL}",
        ]
        arguments = [*options, *self.maps, *variant]
        said = StringIO()
        try:
            with redirect_stdout(said), redirect_stderr(said):
                code = main(scenario, argv=arguments)
        except Exception as error:  # any exception is a finding; the others run all the same
            verdict = f"{type(error).__name__}: {error}"
        else:
            verdict = VERDICTS.get(code, f"exit code {code}")
        lines = self.trace.read_text(encoding="utf-8").splitlines() if self.trace.exists() else []
        return Ended(file, scenario.name, variant, verdict, said.getvalue(), tuple(lines))

    def all(self, file: str, scenario: type[Scenario]) -> Iterator[Ended]:
        first = self.end(file, scenario, VARIANTS[0])
        given = tuple(f"--set={name}=given" for name in re.findall(OPEN, first.said))
        if given:
            first = self.end(file, scenario, (*VARIANTS[0], *given))
        yield first
        missing = re.search(r"map `([^`]+)` not found", first.said)
        if missing:
            name = missing[1] if missing[1].endswith(".xodr") else f"{missing[1]}.xodr"
            shutil.copy(STAND_IN, self.stand_ins / name)
            yield self.end(file, scenario, VARIANTS[0])
        for variant in VARIANTS[1:]:
            yield self.end(file, scenario, (*variant, *given))


@pytest.fixture(scope="module")
def ended(test_data: Path, tmp_path_factory: pytest.TempPathFactory) -> list[Ended]:
    folder = tmp_path_factory.mktemp("modules")
    runs, found = Runs(test_data, folder), []
    for file, module in modules(test_data / "corpus", folder):
        for scenario in own_scenarios(module):
            found += runs.all(file, scenario)
    return found


@pytest.mark.slow
def test_every_scenario_ends_in_a_verdict(ended: list[Ended]) -> None:
    assert [each for each in ended if each.verdict not in VERDICTS.values()] == []
    assert len(ended) >= 3 * 30


@pytest.mark.slow
def test_some_of_them_succeed(ended: list[Ended]) -> None:
    """Without this, a run that refuses everything would pass."""
    verdicts = Counter(each.verdict for each in ended)
    assert verdicts["success"] >= 30
    assert verdicts["unreadable"] < 30  # only where no map stands in yet


@pytest.mark.slow
def test_what_fails_names_a_line_of_its_file(ended: list[Ended]) -> None:
    for each in ended:
        assert "Traceback" not in each.said
        if each.verdict == "failed":
            assert re.search(re.escape(each.file) + r":\d+", each.said), each


@pytest.mark.slow
def test_traces_are_complete_up_to_their_verdict(ended: list[Ended]) -> None:
    """What has begun has ended, in every trace that was written."""
    written = [each for each in ended if each.trace]
    assert len(written) >= 60
    for each in written:
        first, *_, last = (json.loads(line) for line in each.trace)
        assert first["kind"] == "header" and last["kind"] == "result", each.file
        assert (last["status"] == "success") == (each.verdict == "success")
        open_actions: Counter[tuple[str, str]] = Counter()
        for line in map(json.loads, each.trace):
            if line["kind"] == "action":
                open_actions[line["name"], line["source"]] += 1 if line["status"] == "start" else -1
        assert set(open_actions.values()) <= {0}, each.file
