"""A build compiles what changed, and finds everything that a file depends on."""

import os
from pathlib import Path

import pytest

from osc2tx.building import build as module
from osc2tx.config import GivenOptions
from tests.unit.building.projects import Project, write


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the files that builds compile."""
    found: list[str] = []
    compile_jobs = module.compile_jobs

    def watched(jobs, workers, memory, known, *args):  # type: ignore[no-untyped-def]
        found.extend(job.name for job in jobs if job not in known)
        return compile_jobs(jobs, workers, memory, known, *args)

    monkeypatch.setattr(module, "compile_jobs", watched)
    return found


def rebuilt(project: Project, compiled: list[str]) -> list[str]:
    compiled.clear()
    project.build()
    return sorted(compiled)


def test_only_what_changed_is_compiled(project: Project, compiled: list[str]) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    assert rebuilt(project, compiled) == ["a.osc", "b.osc"]
    assert rebuilt(project, compiled) == []
    project.drive("b.osc", speed=31)
    os.utime(project.sources / "a.osc")
    assert rebuilt(project, compiled) == ["b.osc"]


def test_the_same_time_and_size_do_not_deceive(project: Project, compiled: list[str]) -> None:
    path = project.drive("a.osc", speed=30)
    os.utime(path, (1, 1))
    project.build()
    project.drive("a.osc", speed=31)
    os.utime(path, (1, 1))
    assert rebuilt(project, compiled) == ["a.osc"]


def test_transitive_imports_count(project: Project, compiled: list[str]) -> None:
    write(project.sources / "base.osc", "enum color: [red]\n")
    write(project.sources / "lib.osc", 'import "base.osc"\n')
    project.drive("a.osc", head='import "lib.osc"\n')
    project.drive("b.osc")
    project.build()
    (project.sources / "base.osc").unlink()
    assert rebuilt(project, compiled) == ["a.osc", "lib.osc"]
    write(project.sources / "base.osc", "enum vehicle_color: [red, red]\n")  # a mistake
    assert rebuilt(project, compiled) == ["a.osc", "base.osc", "lib.osc"]


def test_a_file_that_would_now_be_found_first_counts(project: Project, compiled: list[str]) -> None:
    write(project.sources / "shapes.osc", "enum color: [red]\n")
    project.drive("sub/a.osc", head="import shapes\n")
    project.build()
    write(project.sources / "sub/shapes.osc", "enum paint: [red]\n")
    assert rebuilt(project, compiled) == ["sub/a.osc", "sub/shapes.osc"]


def test_a_link_that_points_elsewhere_counts(project: Project, compiled: list[str]) -> None:
    for name in ("one", "two"):
        write(project.sources / f"{name}/lib.osc", "enum color: [red]\n")
    link = project.sources / "lib.osc"
    link.symlink_to("one/lib.osc")
    project.drive("a.osc", head='import "lib.osc"\n')
    project.build()
    link.unlink()
    link.symlink_to("two/lib.osc")
    assert "a.osc" in rebuilt(project, compiled)


def test_options_count(project: Project, compiled: list[str]) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    write(project.sources / "osc2tx.toml", "")
    project.build()
    write(project.sources / "osc2tx.toml", '[scenarios.a]\none_of = "first"\n')
    assert rebuilt(project, compiled) == ["a.osc"]


def test_osc2tx_itself_counts(
    project: Project, compiled: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from osc2tx.building import result_cache

    project.drive("a.osc")
    project.build()
    monkeypatch.setattr(result_cache, "tool_stamp", lambda cache: "another")
    assert rebuilt(project, compiled) == ["a.osc"]


def test_outputs_that_are_gone_are_made_again(project: Project, compiled: list[str]) -> None:
    project.drive("a.osc")
    project.drive("b.osc")
    project.build()
    (project.out / "b.py").unlink()
    assert rebuilt(project, compiled) == []  # their texts are stored
    assert project.check() == []


def test_a_damaged_memory_is_none(project: Project, compiled: list[str], cache: Path) -> None:
    project.drive("a.osc")
    project.build()
    for damage in (b"", b"{", b"[]", b'{"format": 1}'):
        for path in (cache / "osc2tx/results").rglob("*"):
            if path.is_file():
                path.write_bytes(damage)
        assert rebuilt(project, compiled) == ["a.osc"]
        assert rebuilt(project, compiled) == []


def test_the_memory_of_somebody_else_is_not_read(
    project: Project, compiled: list[str], cache: Path
) -> None:
    project.drive("a.osc")
    project.build()
    for path in (cache / "osc2tx/results").rglob("*"):
        path.chmod(0o666 if path.is_file() else 0o700)
    assert rebuilt(project, compiled) == ["a.osc"]


def test_without_cache_all_is_compiled(
    project: Project, compiled: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OSC2TX_NO_CACHE", "1")
    project.drive("a.osc")
    project.build()
    assert rebuilt(project, compiled) == ["a.osc"]


def test_remembered_reports_are_those_of_the_first_time(project: Project) -> None:
    from osc2tx.compilation.file_reports import apply_suppressions

    library = "import osc.standard\nscenario base:\n  do serial:\n    wait @gone\n"
    write(project.sources / "lib.osc", library)
    project.drive("a.osc", head='import "lib.osc"\nuse std.stdtypes\n')
    write(project.sources / "bad.osc", "scenario top:\n  x: vehicel\n  x: int\n")
    write(project.sources / "kept.osc", "use std.stdtypes  #! allow OSC601: old\n")
    given = GivenOptions(dialect="carla")

    def reports() -> list[str]:
        results = project.build(given=given).results
        settled = apply_suppressions(results)
        spans = [repr(d.primary) for d in settled.shown]
        entries = [repr(entry) for result in results for entry in result.scenarios]
        return [*map(repr, settled.shown), *map(repr, settled.suppressed), *spans, *entries]

    first = reports()
    assert len(first) > 8
    assert reports() == first
