// First order of the precomputed sky: sunlight scattered once, or reflected by the ground, in each
// direction of the quadrature (lib/bruneton_field.glsl, "incident"), from which the source of the
// second order is made.

#include "lib/bruneton_field.glsl"
#include "lib/bruneton_single.glsl"

out vec4 result;

const int LOBE_SAMPLES = 3;

// Mean of the aerosol's phase function over the cell of directions that a node stands for: a
// node that a narrow lobe falls on would else count it for the whole cell.
Number GetMeanMiePhase(int zenith, int azimuth, Number mu_s) {
  float side = zenith < 8 ? 1.0 : -1.0;
  int node = zenith % 8;
  float level = sqrt(1.0 - mu_s * mu_s);
  float sum = 0.0;
  for (int i = 0; i < LOBE_SAMPLES; ++i) {
    float part = (float(i) + 0.5) / float(LOBE_SAMPLES);
    float mu = side * mix(FIELD_EDGES[node], FIELD_EDGES[node + 1], part);
    float across = sqrt(1.0 - mu * mu) * level;
    for (int k = 0; k < LOBE_SAMPLES; ++k) {
      float turn = float(azimuth) + (float(k) + 0.5) / float(LOBE_SAMPLES);
      sum += MiePhase(aerosol_asymmetry,
                      mu * mu_s + across * cos(PI * turn / float(FIELD_AZIMUTHS)));
    }
  }
  return sum / float(LOBE_SAMPLES * LOBE_SAMPLES);
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  ivec2 tile = texel / field_size.yx;
  ivec2 cell = texel - tile * field_size.yx;
  float mu_s = GetSunCosineOfSample(cell.x, field_size.y);
  float h = GetAltitudeOfCoordinate(float(cell.y) / float(field_size.x - 1));
  float mu = GetFieldZenithCosine(tile.y);
  float nu = GetScatteringCosine(mu, mu_s, cos(GetAzimuth(tile.x, FIELD_AZIMUTHS)));
  bool ground = RayIntersectsGround(h, mu);
  float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
  SingleScattering single = ComputeSingleScattering(h, mu, mu_s, nu, d);
  vec4 radiance = single.air * RayleighPhase(nu)
      + single.haze * GetMeanMiePhase(tile.y, tile.x, mu_s);
  if (ground) {
    radiance += single.transmittance * ground_albedo / PI * GetSunOnGround(h, mu_s, nu, d);
  }
  result = radiance / GetFading(mu_s);
}
