// Radiance of once-scattered sunlight at a point, per unit of solar irradiance (1/sr), for the
// quadrature of the light field: tiles of azimuth along x and of zenith angle along y, in each
// mu_s along x and altitude along y. See lib/multiple.glsl.

#include "lib/multiple.glsl"

uniform vec2 pass_size;
uniform vec2 tile_origin;
uniform sampler2D columns;
out vec4 result;

const int STEPS = 20;
const int LOBE_SAMPLES = 5;

// Mean of the aerosol's phase function over the cell of directions that a node stands for: a
// node that a narrow lobe falls on would else count it for the whole cell.
Number GetMeanMiePhase(int zenith, int azimuth, Number mu_s) {
  float side = zenith < 4 ? 1.0 : -1.0;
  int node = zenith < 4 ? zenith : zenith - 4;
  float level = sqrt(1.0 - mu_s * mu_s);
  float sum = 0.0;
  for (int i = 0; i < LOBE_SAMPLES; ++i) {
    float part = (float(i) + 0.5) / float(LOBE_SAMPLES);
    float mu = side * mix(EDGES[node], EDGES[node + 1], part);
    float across = sqrt(1.0 - mu * mu) * level;
    for (int k = 0; k < LOBE_SAMPLES; ++k) {
      float turn = (float(azimuth) + (float(k) + 0.5) / float(LOBE_SAMPLES)) / float(AZIMUTHS);
      sum += MiePhase(aerosol_asymmetry, mu * mu_s + across * cos(PI * turn));
    }
  }
  return sum / float(LOBE_SAMPLES * LOBE_SAMPLES);
}

void main() {
  ivec2 tiles = ivec2(AZIMUTHS, ZENITHS);
  ivec2 texel = ivec2(gl_FragCoord.xy + tile_origin);
  ivec2 size = ivec2(pass_size) / tiles;
  ivec2 tile = texel / size;
  vec2 place = vec2(texel - tile * size) / vec2(size - 1);
  float mu_s = GetSunCosineOfField(place.x);
  float h = GetAltitudeOfField(place.y);
  vec2 direction = GetFieldDirection(tile.y, tile.x, AZIMUTHS);
  float mu = direction.y;
  float nu = mu * mu_s + direction.x * sqrt(1.0 - mu_s * mu_s);

  mat3x4 coefficients = GetExtinctionCoefficients();
  float rayleigh_phase = RayleighPhase(nu);
  float mie_phase = GetMeanMiePhase(tile.y, tile.x, mu_s) * aerosol_albedo;
  float r = GROUND_RADIUS + h;
  bool ground = RayIntersectsGround(h, mu);
  float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
  vec4 transmittance = vec4(1.0);
  vec4 radiance = vec4(0.0);
  for (int i = 0; i < STEPS; ++i) {
    float u = (float(i) + 0.5) / float(STEPS);
    float t = d * u * u;
    float dt = 2.0 * d * u / float(STEPS);
    float h_t = GetAltitudeAlongRay(h, mu, t);
    float mu_s_t = clamp((r * mu_s + t * nu) / (GROUND_RADIUS + h_t), -1.0, 1.0);
    vec3 density = GetDensity(h_t);
    vec4 rayleigh = coefficients[0] * density.x;
    vec4 mie = coefficients[1] * density.y;
    vec4 extinction = coefficients * density;
    radiance += transmittance * (rayleigh * rayleigh_phase + mie * mie_phase)
        * GetTransmittanceToSun(columns, h_t, mu_s_t) * IntegrateTransmittance(extinction, dt);
    transmittance *= exp(-extinction * dt);
  }
  if (ground) {
    float mu_s_ground = clamp((r * mu_s + d * nu) / GROUND_RADIUS, -1.0, 1.0);
    radiance += transmittance * ground_albedo / PI * max(mu_s_ground, 0.0)
        * GetTransmittanceToSun(columns, 0.0, mu_s_ground);
  }
  result = radiance;
}
