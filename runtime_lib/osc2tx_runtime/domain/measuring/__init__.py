"""What is read of actors and weather in expressions."""
