"""Files and folders: archives, the user's cache, temporary folders."""
