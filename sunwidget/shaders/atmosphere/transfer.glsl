// Uniform light of radiance one after one scattering, the ground's reflection included:
// its moments mean, z, xx and zz along x (it is symmetric around the zenith, so the others vanish),
// altitude along y. See atmosphere/multiple.glsl.

#include "atmosphere/multiple.glsl"

uniform vec2 pass_size;
uniform vec2 tile_origin;
out vec4 result;

const int kSteps = 12;

// Radiance along mu at altitude h of air lit uniformly with radiance one.
vec4 GetTransfer(Length h, Number mu) {
  mat3x4 coefficients = GetExtinctionCoefficients();
  bool ground = RayIntersectsGround(h, mu);
  float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
  vec4 transmittance = vec4(1.0);
  vec4 radiance = vec4(0.0);
  for (int i = 0; i < kSteps; ++i) {
    float u = (float(i) + 0.5) / float(kSteps);
    float dt = 2.0 * d * u / float(kSteps);
    vec3 density = GetDensity(GetAltitudeAlongRay(h, mu, d * u * u));
    vec4 extinction = coefficients * density;
    radiance += transmittance * IntegrateTransmittance(extinction, dt)
        * (coefficients[0] * density.x + coefficients[1] * density.y * aerosol_albedo);
    transmittance *= exp(-extinction * dt);
  }
  return radiance + (ground ? ground_albedo * transmittance : vec4(0.0));
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy + tile_origin);
  float h = GetAltitudeOfField(float(texel.y) / (pass_size.y - 1.0));
  result = vec4(0.0);
  for (int j = 0; j < kZeniths; ++j) {
    float mu = GetZenithCosine(j);
    // <w_x^2> = (1 - mu^2) / 2.
    float weight = texel.x == 0 ? 1.0
        : texel.x == 1 ? mu
        : texel.x == 2 ? 0.5 * (1.0 - mu * mu) - 1.0 / 3.0
        : mu * mu - 1.0 / 3.0;
    result += 0.5 * kWeights[j % 4] * weight * GetTransfer(h, mu);
  }
}
