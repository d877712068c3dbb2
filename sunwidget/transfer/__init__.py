"""Light taken from other photos: a donor's sky, and the look of a before/after pair."""
