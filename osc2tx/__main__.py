"""`python -m osc2tx`."""

from osc2tx.start import main

main()
