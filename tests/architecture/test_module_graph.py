"""The helper of these tests finds what it is made to find."""

from pathlib import Path

from tests.architecture.module_graph import circles, graph_of


def test_all_kinds_of_imports_make_circles(tmp_path: Path) -> None:
    texts = {
        "__init__.py": "",
        "a.py": "def late():\n    from pack.b import x\n",
        "b.py": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from pack import c\n",
        "c.py": "from .folder import d\n",
        "folder/__init__.py": "",
        "folder/d.py": "import pack.a\nfrom ..e import y\n",
        "e.py": "import os\n",
    }
    for name, text in texts.items():
        path = tmp_path / "pack" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    graph = graph_of(tmp_path / "pack")
    assert graph["pack.folder.d"] == {"pack.a", "pack.e"}
    assert circles(graph) == [{"pack.a", "pack.b", "pack.c", "pack.folder.d"}]
