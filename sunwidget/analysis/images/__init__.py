"""Small copies of a photo and what is done to any picture: enlarging, filling, noise, color."""
