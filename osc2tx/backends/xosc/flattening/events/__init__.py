"""Events of a scenario, and the directives that emit them or wait for them."""
