"""One impact as a page for others: what is known of a design, and how well."""
