"""Mathematics on arrays; knows no body and no contact law."""
