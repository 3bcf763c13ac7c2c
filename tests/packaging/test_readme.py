"""README shows what the files say."""

import re
import runpy
from pathlib import Path

REPOSITORY = Path(__file__).parent.parent.parent
README = (REPOSITORY / "README.md").read_text(encoding="utf-8")


def test_the_example_is_fresh() -> None:
    tool = runpy.run_path(str(REPOSITORY / "tools" / "make_readme_example.py"))
    assert tool["with_example"](README) == README


def test_files_it_links_to_exist() -> None:
    for target in re.findall(r"\]\(([^)#]+)\)", README):
        assert (REPOSITORY / target).exists(), target
