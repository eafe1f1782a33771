"""The command `impact`: one module for each of its larger words."""
