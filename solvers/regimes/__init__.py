"""The smallest model that answers a question about an impact, as measured."""
