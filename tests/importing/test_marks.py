"""Variables as events, and what is kept of them."""

from tests.importing.documents import at_time, document, event, faults, imported, speed_change
from tests.importing.test_structure import apart

SET = """<Event name="Set" priority="parallel"><Action name="SetAction"><GlobalAction>
  <VariableAction variableRef="holds"><SetAction value="true"/></VariableAction></GlobalAction>
  </Action><StartTrigger><ConditionGroup>{}</ConditionGroup></StartTrigger></Event>"""
HOLDS = """<Condition name="holds" delay="0" conditionEdge="none"><ByValueCondition>
  <VariableCondition variableRef="holds" rule="equalTo" value="{}"/></ByValueCondition>
  </Condition>"""
DECLARED = """<VariableDeclarations><VariableDeclaration name="holds" variableType="boolean"
  value="false"/></VariableDeclarations>"""


def test_a_condition_beside_a_time_sees_what_was_set_before() -> None:
    """Set at 1 s: at 2 s it holds, at 3 s it no longer has the value of the start."""
    then = event("Then", speed_change("20", "2"), at_time("2") + HOLDS.format("true"))
    never = event("Never", speed_change("5", "2"), at_time("3") + HOLDS.format("false"))
    text = document(SET.format(at_time("1")) + then + never)
    found = imported(text.replace("<CatalogLocations/>", f"{DECLARED}<CatalogLocations/>"))
    assert "holds_came: bool = sample(true, @holds, false)" in found.text
    assert "wait holds_came" in found.text
    assert "wait not holds_came" in found.text
    assert faults(found) == []
    assert apart(found) < 0.1
