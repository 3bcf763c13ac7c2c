"""Traffic lights as scenarios speak of them (DSL 8.15): lamps, groups, cycles, stop lines."""
