"""What the jobs of a build know from each other: imported files are compiled once."""

from itertools import pairwise
from pathlib import Path

from osc2tx.building.jobs import find_jobs
from osc2tx.building.results import compile_job
from osc2tx.compilation.driver import Memory
from osc2tx.config import ConfigFiles
from tests.unit.building.projects import MODULES, Project, write

BASE = """import lib.limits

scenario measured:
  ego: limited_car
  v: speed with:
    keep(it in [1kph..50kph])
"""
CASE = """import osc.standard
import lib.base

scenario {name} inherits measured:
  do ego.drive(duration: 1s) with:
    speed(v)
"""


def test_imported_files_are_compiled_once_for_all_jobs(project: Project) -> None:
    write(project.sources / "osc2tx.toml", 'sources = ["."]\n')
    write(
        project.sources / "lib/limits.osc",
        "import osc.standard\n\nactor limited_car inherits vehicle:\n  most: speed\n",
    )
    write(project.sources / "lib/base.osc", "import osc.standard\n" + BASE)
    for name in ("a", "b", "c"):
        write(project.sources / f"{name}.osc", CASE.format(name=name))
    memory: Memory = {}
    seen = []
    for job in find_jobs([project.sources], MODULES, ConfigFiles()):
        result = compile_job(job, memory)
        assert not result.bug and result.is_complete, result.reports
        seen.append(dict(memory))
    for before, after in pairwise(seen):
        assert before.items() <= after.items(), "none was compiled again"


def test_an_imported_file_that_changed_is_compiled_again(project: Project, tmp_path: Path) -> None:
    write(project.sources / "osc2tx.toml", 'sources = ["."]\n')
    base = write(
        project.sources / "lib/base.osc",
        "import osc.standard\n\nscenario measured:\n  ego: vehicle\n  v: speed\n",
    )
    write(project.sources / "a.osc", CASE.format(name="a"))
    (job,) = (j for j in find_jobs([project.sources], MODULES, ConfigFiles()) if j.name == "a.osc")
    memory: Memory = {}
    compile_job(job, memory)
    first = dict(memory)
    base.write_text(base.read_text() + "  w: speed\n")
    compile_job(job, memory)
    assert memory.keys() == first.keys() and memory != first
