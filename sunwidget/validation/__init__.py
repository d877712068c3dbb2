"""How far the clear sky is from what others measured and computed."""
