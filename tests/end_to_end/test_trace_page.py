"""The page docs/trace.md: its scenario runs, and its examples are lines of that run."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.end_to_end.harness import REPOSITORY
from tests.unit.cli.shell import Shell

PAGE = REPOSITORY / "docs" / "trace.md"
TELLING = ("kind", "t", "actor", "status", "name")  # what tells the lines of that run apart


def key_of(line: str) -> tuple[object, ...]:
    values = json.loads(line)
    return tuple(values.get(key) for key in TELLING)


def test_the_examples_are_lines_of_the_run(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    request: pytest.FixtureRequest,
) -> None:
    """`--update-golden` writes those that changed."""
    text = PAGE.read_text(encoding="utf-8")
    (source,) = re.findall(r"^```osc\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    monkeypatch.chdir(tmp_path)
    Path("overtake.osc").write_text(source, encoding="utf-8")
    assert Shell(capsys, tmp_path)("run", "overtake.osc", "--trace", "t.jsonl").code == 5
    lines = Path("t.jsonl").read_text(encoding="utf-8").splitlines()
    by_key = {key_of(line): line for line in lines}
    replaced = []

    def current(shown: re.Match[str]) -> str:
        replaced.append(key := key_of(shown[0]))
        return by_key.get(key, shown[0])

    page = re.sub(r"^\{.*\}$", current, text, flags=re.MULTILINE)
    if request.config.getoption("--update-golden"):
        PAGE.write_text(page, encoding="utf-8")
    assert page == text
    assert len(by_key.keys() & set(replaced)) == 10
