// Bounds a log of light smoothly to +-`most`.
float GetBounded(float log_light, float most) {
  return log_light * inversesqrt(1.0 + log_light * log_light / (most * most));
}
