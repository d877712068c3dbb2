// Radiance of once-scattered sunlight at a point, per unit of solar irradiance (1/sr), for the
// quadrature of the light field. See atmosphere/multiple.glsl.

#include "atmosphere/multiple.glsl"

uniform vec2 pass_size;
uniform vec2 tile_origin;
uniform sampler2D columns;
out vec4 result;

const int kSteps = 20;
const int kLobeSamples = 5;

// Mean of the aerosol's phase function over the cell of directions that a node represents: otherwise
// a narrow lobe that falls on a node would count for the whole cell.
Number GetMeanMiePhase(int zenith, int azimuth, Number mu_s) {
  float side = zenith < 4 ? 1.0 : -1.0;
  int node = zenith < 4 ? zenith : zenith - 4;
  float level = sqrt(1.0 - mu_s * mu_s);
  float sum = 0.0;
  for (int i = 0; i < kLobeSamples; ++i) {
    float part = (float(i) + 0.5) / float(kLobeSamples);
    float mu = side * mix(kEdges[node], kEdges[node + 1], part);
    float across = sqrt(1.0 - mu * mu) * level;
    for (int k = 0; k < kLobeSamples; ++k) {
      float turn = (float(azimuth) + (float(k) + 0.5) / float(kLobeSamples)) / float(kAzimuths);
      sum += MiePhase(aerosol_asymmetry, mu * mu_s + across * cos(kPi * turn));
    }
  }
  return sum / float(kLobeSamples * kLobeSamples);
}

void main() {
  FieldRay ray = GetFieldRay(ivec2(gl_FragCoord.xy + tile_origin), ivec2(pass_size), kAzimuths);
  mat3x4 coefficients = GetExtinctionCoefficients();
  float rayleigh_phase = RayleighPhase(ray.nu);
  float mie_phase = GetMeanMiePhase(ray.tile.y, ray.tile.x, ray.mu_s) * aerosol_albedo;
  float r = kGroundRadius + ray.h;
  vec4 transmittance = vec4(1.0);
  vec4 radiance = vec4(0.0);
  for (int i = 0; i < kSteps; ++i) {
    float u = (float(i) + 0.5) / float(kSteps);
    float t = ray.d * u * u;
    float dt = 2.0 * ray.d * u / float(kSteps);
    float h_t = GetAltitudeAlongRay(ray.h, ray.mu, t);
    float mu_s_t = clamp((r * ray.mu_s + t * ray.nu) / (kGroundRadius + h_t), -1.0, 1.0);
    vec3 density = GetDensity(h_t);
    vec4 rayleigh = coefficients[0] * density.x;
    vec4 mie = coefficients[1] * density.y;
    vec4 extinction = coefficients * density;
    radiance += transmittance * (rayleigh * rayleigh_phase + mie * mie_phase)
        * GetTransmittanceToSun(columns, h_t, mu_s_t) * IntegrateTransmittance(extinction, dt);
    transmittance *= exp(-(extinction * dt));
  }
  if (ray.ground) {
    float mu_s_ground = clamp((r * ray.mu_s + ray.d * ray.nu) / kGroundRadius, -1.0, 1.0);
    radiance += transmittance * ground_albedo / kPi * max(mu_s_ground, 0.0)
        * GetTransmittanceToSun(columns, 0.0, mu_s_ground);
  }
  result = radiance;
}
