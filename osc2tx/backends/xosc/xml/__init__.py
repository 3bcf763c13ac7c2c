"""The language of documents: elements and versions, names, and what tools make of them."""
