"""Studies: one scene at many points."""
