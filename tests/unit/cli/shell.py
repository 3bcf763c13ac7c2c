"""The command line in this process: what it printed and returned."""

from dataclasses import dataclass
from pathlib import Path

import pytest

from osc2tx import cli

DRIVE = """import osc.standard

scenario {name}:
  ego: vehicle
  do serial:
    ego.drive(duration: 2s) with:
      speed(30kph)
"""


@dataclass
class Ended:
    code: int
    out: str
    err: str


class Shell:
    def __init__(self, capsys: pytest.CaptureFixture[str], folder: Path) -> None:
        self.capsys = capsys
        self.folder = folder

    def __call__(self, *arguments: object) -> Ended:
        with pytest.raises(SystemExit) as caught:
            cli.main([str(argument) for argument in arguments])
        captured = self.capsys.readouterr()
        assert "Traceback" not in captured.err
        return Ended(int(str(caught.value.code)), captured.out, captured.err)

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def drive(self, name: str, *scenarios: str) -> Path:
        first, *more = scenarios or ("top",)
        text = DRIVE.format(name=first)
        for scenario in more:
            text += "\n" + DRIVE.format(name=scenario).partition("\n\n")[2]
        return self.write(name, text)
