"""Where actors are put: by modifiers, by settings, before step 0."""
