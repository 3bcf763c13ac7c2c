"""Public scenarios: how many files parse, and why the others do not."""

import csv
from pathlib import Path

import pytest

from osc2tx.diagnostics import DiagnosticSink, Severity
from osc2tx.syntax import parse, read_source

# May only rise.
PARSED_WITHOUT_A_WORD = 649

# Files that some other front end accepts although the language does not.
DEVIATIONS = {
    "test_cover.osc": "`cover()` without arguments",
    "AStructHasNoBehaviorSpecification.L551.osc": "`do` in a struct",
    "AnUnknownSiBaseUnitIsReported.L149.osc": "a base unit that does not exist",
    "4)naman_ego_approaching_stopped_lead.osc": "a dedent to a column that no block has",
    "5)naman_ego_approaching_slow_lead.osc": "a dedent to a column that no block has",
}


@pytest.mark.slow
def test_corpus(test_data: Path) -> None:
    corpus = test_data / "corpus"
    silent = 0
    refused = set()
    with (corpus / "MANIFEST.csv").open(newline="", encoding="utf-8") as manifest:
        for row in csv.DictReader(manifest):
            sink = DiagnosticSink()
            source = read_source(corpus / row["file"], row["file"], sink)
            if source is not None:
                parse(source, sink)
            found = sink.sorted()
            silent += not found
            if row["syntax_accepted_by"] and any(d.severity is Severity.ERROR for d in found):
                refused.add(row["file"].rpartition("/")[2].removeprefix("TestOSC2Parser."))
    assert refused == set(DEVIATIONS)
    assert silent >= PARSED_WITHOUT_A_WORD
