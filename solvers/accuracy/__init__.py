"""How near a solution is to the truth, what that costs, and how little will do for a tolerance."""
