"""From source files to products: `driver` runs the stages, `products` are files, `dump` prints."""
