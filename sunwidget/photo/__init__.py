"""From a file to a Photo: decoding, color management, place and time."""
