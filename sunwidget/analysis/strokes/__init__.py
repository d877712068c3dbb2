"""What a person corrects with strokes, worked out only where they touch."""
