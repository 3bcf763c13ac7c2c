"""The interface to what moves the actors: setpoints out, measurements back."""
