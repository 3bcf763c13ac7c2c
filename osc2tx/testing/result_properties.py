"""Properties of a test in JUnit, beside the values that its scenario fixes."""

VERDICT = "osc2tx.verdict"
EXPECTED = "osc2tx.expected"
REASON = "osc2tx.reason"
VIOLATION = "osc2tx.violation"
TRACE = "osc2tx.trace"
