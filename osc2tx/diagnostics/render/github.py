"""Diagnostics as commands of GitHub's workflows: they appear beside the lines of a pull request.

A command ends with its line, and text of a scenario must not begin another one: every part of it
is made visible, and escaped as GitHub's runner undoes it.
"""

from __future__ import annotations

from osc2tx.diagnostics.codes import CODES
from osc2tx.diagnostics.model import Diagnostic
from osc2tx.diagnostics.report import Report, display_name
from osc2tx_shared.text import visible, without_commands

MOST_COMMANDS = 200  # more is not readable in a pull request


def render_github(report: Report) -> str:
    """Return a command for each diagnostic, and one for each file of which some are not shown."""
    commands = [_command(diagnostic, report) for diagnostic in report.diagnostics]
    commands += [
        f"::notice {_properties({'file': file})}::{_data(f'{count} more not shown')}"
        for file, count in report.hidden.items()
    ]
    commands += [
        f"::error {_properties({'file': fault.file, 'title': f'osc2tx {fault.rule}'})}"
        f"::{_data(fault.message)}"
        for fault in report.faults
    ]
    if len(commands) > MOST_COMMANDS:
        commands.sort(key=lambda command: not command.startswith("::error "))
        more = f"{len(commands) - MOST_COMMANDS} more annotations not shown, errors come first;"
        more += " `--output-format json` has all"
        commands[MOST_COMMANDS:] = [f"::notice {_properties({'title': 'osc2tx'})}::{_data(more)}"]
    if report.failure is not None:
        commands.append(f"::error {_properties({'title': 'osc2tx'})}::{_data(report.failure)}")
    return "".join(f"{command}\n" for command in commands)


def _command(diagnostic: Diagnostic, report: Report) -> str:
    properties: dict[str, object] = {}
    span = diagnostic.primary
    if span is not None:
        line, column = span.source.position(span.start)
        end_line, end_column = span.source.position(max(span.start, span.end - 1))
        properties |= {"file": display_name(span.source, report.folder), "line": line}
        properties |= {"endLine": end_line}
        if line == end_line:  # the runner drops a command with columns of several lines
            properties |= {"col": column, "endColumn": end_column}
    entry = CODES[diagnostic.code]
    properties["title"] = f"{entry.code} {entry.slug}"
    lines = [diagnostic.message, *(f"note: {note}" for note in diagnostic.notes)]
    for label in diagnostic.labels:
        place = f"{display_name(label.span.source, report.folder)}:{label.span.line}"
        lines.append(f"{place}: {label.message}")
    if diagnostic.help is not None:
        lines.append(f"help: {diagnostic.help}")
    return f"::{diagnostic.severity.value} {_properties(properties)}::{_data(*lines)}"


def _properties(values: dict[str, object]) -> str:
    return ",".join(f"{name}={_property(str(value))}" for name, value in values.items())


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")


def _data(*lines: str) -> str:
    shown = (without_commands(visible(line)) for line in lines)
    return "%0A".join(line.replace("%", "%25") for line in shown)
