"""What photos teach about the light of skies."""
