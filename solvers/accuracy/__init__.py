"""The error of a solution, what it costs, and the cheapest solution within a tolerance."""
