"""Words: notes as code and values, and catalogues that make sentences of them, one folder a language."""
