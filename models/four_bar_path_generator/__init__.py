"""The four-bar path generator whose links bend: the example of Erdman, Sandor and Oakberg (1972)."""
