"""Builds whose sources import libraries: what is compiled again, copied and compared."""

from pathlib import Path

from osc2tx.building.compare import compare_with
from osc2tx.building.watch import files_read
from osc2tx.config import GivenOptions
from tests.end_to_end.test_imported_modules import imports_in
from tests.unit.building.projects import Project, write
from tests.unit.building.test_revision import git

TYPES = "import osc.standard\nstruct limits:\n    top: speed = {}kph\n"
DRIVE = """import osc.standard
import company.limits

scenario top:
    ego: vehicle
    mine: limits
    do serial:
        ego.drive(duration: 1s) with:
            speed(mine.top)
"""


def library_module(project: Project) -> str:
    return (project.out / "company/limits.py").read_text(encoding="utf-8")


def test_an_edit_of_a_library_builds_again(tmp_path: Path) -> None:
    project = Project(tmp_path)
    write(project.sources / "a.osc", DRIVE)
    library = write(tmp_path / "lib/company/limits.osc", TYPES.format(30))
    given = GivenOptions(import_paths=(str(tmp_path / "lib"),))
    result = project.build(given=given)
    assert str(library) in files_read(result.results)  # what --watch looks at
    text = (project.out / "a.py").read_text(encoding="utf-8")
    assert imports_in(text) == {"company.limits": ["Limits"]}
    assert project.build(given=given).written == ()
    write(library, TYPES.format(40))
    assert project.written(project.build(given=given)) != []
    assert "40" in library_module(project)


def test_a_file_that_comes_to_stand_before_a_library_counts(tmp_path: Path) -> None:
    project = Project(tmp_path)
    write(project.sources / "a.osc", DRIVE)
    write(tmp_path / "two/company/limits.osc", TYPES.format(30))
    given = GivenOptions(import_paths=(str(tmp_path / "one"), str(tmp_path / "two")))
    project.build(given=given)
    write(tmp_path / "one/company/limits.osc", TYPES.format(40))
    project.build(given=given)
    assert "40" in library_module(project)


def test_a_link_that_comes_to_lead_to_another_library_builds_again(tmp_path: Path) -> None:
    project = Project(tmp_path)
    write(project.sources / "a.osc", DRIVE)
    for version, top in (("v1", 30), ("v2", 40)):
        write(tmp_path / version / "company/limits.osc", TYPES.format(top))
    link = tmp_path / "lib"
    given = GivenOptions(import_paths=(str(link),))
    link.symlink_to(tmp_path / "v1")
    project.build(given=given)
    link.unlink()
    link.symlink_to(tmp_path / "v2")
    project.build(given=given)
    assert "40" in library_module(project)


def test_a_library_in_the_folder_that_is_built_is_imported(tmp_path: Path) -> None:
    project = Project(tmp_path)
    write(project.sources / "a.osc", DRIVE)
    write(project.sources / "vendor/company/limits.osc", TYPES.format(30))
    write(tmp_path / "osc2tx.toml", 'import_paths = ["in/vendor"]\n')
    project.build()
    text = (project.out / "a.py").read_text(encoding="utf-8")
    assert imports_in(text) == {"vendor.company.limits": ["Limits"]}
    assert "A copy" not in text


def test_a_revision_has_its_own_library(tmp_path: Path) -> None:
    project = Project(tmp_path)
    write(project.sources / "a.osc", DRIVE)
    library = write(tmp_path / "lib/company/limits.osc", TYPES.format(30))
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-qm", "one")
    write(library, TYPES.format(40))
    given = GivenOptions(target="py", import_paths=(str(tmp_path / "lib"),))
    compared = compare_with("HEAD", [project.sources], given, workers=1)
    assert [each.path for each in compared.differences] == ["company/limits.py"]
    assert compared.problems == ()
