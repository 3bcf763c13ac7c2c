"""`python -m osc2tx`."""

from osc2tx.cli import main

main()
