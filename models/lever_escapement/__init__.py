"""The lever escapement: a balance that swings freely but for the short time in which it moves the lever."""
