// Moments of a radiance drawn for the quadrature of atmosphere/multiple.glsl.

#include "atmosphere/multiple.glsl"

Number GetMomentWeight(int moment, vec2 direction, Number mu_s) {
  float nu = direction.y * mu_s + direction.x * sqrt(1.0 - mu_s * mu_s);
  return moment == 0 ? 1.0
      : moment == 1 ? direction.x
      : moment == 2 ? direction.y
      : moment == 3 ? direction.x * direction.x - 1.0 / 3.0
      : moment == 4 ? direction.y * direction.y - 1.0 / 3.0
      : moment == 5 ? direction.x * direction.y
      : 0.5 * nu * (5.0 * nu * nu - 3.0);
}

// `cell`: sun and altitude within a tile of `size`. Divided by GetTwilight, as the field is stored.
vec4 GetMoment(sampler2D radiance, int azimuths, int moment, ivec2 cell, ivec2 size) {
  float mu_s = GetSunCosineOfField(float(cell.x) / float(size.x - 1));
  vec4 sum = vec4(0.0);
  for (int j = 0; j < kZeniths; ++j) {
    for (int k = 0; k < azimuths; ++k) {
      float weight = GetMomentWeight(moment, GetFieldDirection(j, k, azimuths), mu_s);
      sum += 0.5 * kWeights[j % 4] / float(azimuths) * weight
          * texelFetch(radiance, ivec2(k, j) * size + cell, 0);
    }
  }
  return sum / GetTwilight(mu_s);
}
