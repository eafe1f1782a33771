"""Built-in scenes as TOML files, each with its source, and what reads them."""
