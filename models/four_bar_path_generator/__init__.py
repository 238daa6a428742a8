"""A four-bar path generator whose links bend, as in Fig. 3 of Erdman, Sandor and Oakberg (1972)."""
