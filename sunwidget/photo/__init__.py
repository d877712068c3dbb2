"""Open a file as a Photo: decoding, color management, place and time."""
