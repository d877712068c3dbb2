"""The sky model fitted to a photo, and how far the fit can be believed."""
