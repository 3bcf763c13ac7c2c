"""Goals of actors whose motion is measured: how far they are from them, when they are reached."""
