"""Puts the example into README.md: a scenario and, beside it, the compiled module.

Run it after a change of scenarios/cut_in.osc or of the backend; a test compares.
"""

from pathlib import Path

REPOSITORY = Path(__file__).parent.parent
BEGIN, END = "<!-- example: begin -->", "<!-- example: end -->"

ROW = """
<table>
<tr><th align="left">scenarios/cut_in.osc</th>
<th align="left">generated/cut_in.py (excerpt)</th></tr>
<tr valign="top"><td>

```python
{source}
```

</td><td>

```python
{module}
```

</td></tr>
</table>
"""


def example() -> str:
    """Return the section, its two texts cut from the files themselves."""
    source = (REPOSITORY / "scenarios/cut_in.osc").read_text(encoding="utf-8")
    module = (REPOSITORY / "generated/cut_in.py").read_text(encoding="utf-8")
    shown = module[module.index("class CutIn") : module.index("def create_root")]
    return ROW.format(source=source.strip(), module=shown.strip())


def with_example(readme: str) -> str:
    """Return the text of the README with the section renewed."""
    before, rest = readme.split(BEGIN)
    after = rest.split(END)[1]
    return f"{before}{BEGIN}\n{example()}\n{END}{after}"


if __name__ == "__main__":
    path = REPOSITORY / "README.md"
    path.write_text(with_example(path.read_text(encoding="utf-8")), encoding="utf-8")
