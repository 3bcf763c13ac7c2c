"""Actions of vehicle lights and traffic lights."""
