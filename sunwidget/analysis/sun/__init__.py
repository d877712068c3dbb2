"""The photo's own sun: its position, its glare, and the photo without it."""
