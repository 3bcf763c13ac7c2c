"""Documents of public scenarios do what the embedded world does, as those of our own have to."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from osc2tx.options import XmlOptions
from osc2tx_runtime import RunSettings
from osc2tx_shared.map_files import SHIPPED
from tests.corpus.report import INVALID, OPTIONS, manifest, roots_of
from tests.unit.backends.xosc.documents import compiled
from tests.xosc.parity import FINE, Given, check, is_stated, played, scenarios

MAPS = ("carla-2020", "esmini")
FAILS = "emit fail"
LEAST = 20  # documents, so that all this compares enough

pytestmark = pytest.mark.slow


def sources(test_data: Path) -> Iterator[Given]:
    """Yield the files of the corpus that build."""
    maps = tuple(test_data / "maps" / name for name in MAPS)
    settings = RunSettings(dt=FINE, map_path=maps)
    xml = XmlOptions(allow_approx=True, map_path=tuple(map(str, maps)))
    corpus = test_data / "corpus"
    for row in manifest(corpus):
        if row["kind"] == INVALID:
            continue
        roots = tuple(str(root) for root in roots_of(corpus, row))
        options = replace(OPTIONS[row["dialect"]], import_paths=roots)
        compilation = compiled(corpus / row["file"], options)
        if compilation.module is not None and compilation.ir is not None:
            yield Given(corpus / row["file"], settings, options, xml, (*maps, SHIPPED))


def test_documents_are_like_the_world(test_data: Path) -> None:
    written = 0
    for source in sources(test_data):
        for document in scenarios(source):
            if document.xml is None:
                continue
            written += 1
            if not is_stated(document):
                played(document.xml, 0.1, source.maps, most=10.0)
            elif all(entry.construct != FAILS for entry in document.report.entries):
                check(source, document)
    assert written >= LEAST
