// Henyey–Greenstein lobe relative to isotropic scattering, g = 0.8: forward scattering of thin cloud.
float GetForwardLobe(float cosine) {
  const float g = 0.8;
  float base = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (base * sqrt(base));
}
