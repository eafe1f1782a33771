"""The smallest model that answers a question about a blow, as measured."""
