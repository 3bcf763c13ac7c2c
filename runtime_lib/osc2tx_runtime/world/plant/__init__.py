"""The interface to the plant that moves the actors: setpoints out, measurements back."""
