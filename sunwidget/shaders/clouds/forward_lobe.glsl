// Henyey–Greenstein lobe over its isotropic value, g = 0.8: what thin cloud sends on.
float GetForwardLobe(float cosine) {
  const float g = 0.8;
  float base = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (base * sqrt(base));
}
