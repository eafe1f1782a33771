"""The page: its laboratory, panels and address."""
