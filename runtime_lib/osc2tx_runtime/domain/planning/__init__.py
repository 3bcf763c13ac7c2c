"""Plans: from the modifiers of an action to the commands of the world."""
