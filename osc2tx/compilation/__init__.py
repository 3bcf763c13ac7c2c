"""From source files to products: `driver` runs the stages, `products` says what they make."""
