"""The photo's own sun: where it is, its glare, and the photo without it."""
