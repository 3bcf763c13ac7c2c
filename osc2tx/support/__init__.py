"""Support modules for every stage; they import nothing else of osc2tx."""
