"""The reduction of records of a split Hopkinson bar."""
