"""From diagnostics to text for people and documents for programs.

`text` is for people. Four forms are for programs and print a whole `Report` at once: `json_report`
(`docs/diagnostics.schema.json` describes it), `sarif` (SARIF 2.1.0), `github` (commands of
GitHub's workflows) and `rdjson` (suggested changes, through reviewdog). Each is a function of the
report alone: same report, same bytes.
`explanation` prints the documentation of a code.
"""

from osc2tx.diagnostics.render.explanation import explanation_data, render_explanation
from osc2tx.diagnostics.render.github import render_github
from osc2tx.diagnostics.render.json_report import render_json
from osc2tx.diagnostics.render.rdjson import render_rdjson
from osc2tx.diagnostics.render.sarif import render_sarif
from osc2tx.diagnostics.render.text import render_all, render_text
from osc2tx.diagnostics.report import display_name

__all__ = [
    "display_name",
    "explanation_data",
    "render_all",
    "render_explanation",
    "render_github",
    "render_json",
    "render_rdjson",
    "render_sarif",
    "render_text",
]
