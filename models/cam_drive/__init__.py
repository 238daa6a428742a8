"""A cam drive: a cam swings a follower arm through its roller, and a spring holds them together."""
