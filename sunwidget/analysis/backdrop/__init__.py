"""The sky behind the sun and behind the clouds."""
