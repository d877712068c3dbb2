"""Light transferred from other photos: a donor's sky, or the look of a before/after pair."""
