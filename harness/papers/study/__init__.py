"""The study of the paper's ratchet: twenty wheels, and what the paper claims of them."""
