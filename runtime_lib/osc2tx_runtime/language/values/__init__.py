"""Parameters of a scenario: given, drawn, printed with units."""
