"""Which pixels are sky: coarse, refined to a decision, then a matte."""
