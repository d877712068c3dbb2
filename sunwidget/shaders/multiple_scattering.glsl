// The field of all scattered light around a point, as moments (see lib/multiple.glsl): first and
// second order as drawn, the rest as a geometric series of isotropic scattering (Hillaire 2020,
// section 5.5.3). Its ratio is f, the share of an even light that comes back after one more
// scattering, the ground's included; or what the second order had of the first where that is
// less, for over bright ground f counts on a light that has long left through the top.
// `scattering_orders` n ends the sum (Nishita et al. 1996): the field holds orders 1 to n - 1, of
// which the sky view makes 2 to n.

#include "lib/multiple.glsl"
#include "lib/moments.glsl"

uniform float scattering_orders;  // 0: all
uniform vec2 pass_size;
uniform vec2 tile_origin;
uniform sampler2D first_field;
uniform sampler2D second_order;
out vec4 result;

const int STEPS = 12;

// Radiance along mu at altitude h of air that is lit evenly with radiance one.
vec4 GetTransfer(Length h, Number mu) {
  mat3x4 coefficients = GetExtinctionCoefficients();
  bool ground = RayIntersectsGround(h, mu);
  float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
  vec4 transmittance = vec4(1.0);
  vec4 radiance = vec4(0.0);
  for (int i = 0; i < STEPS; ++i) {
    float u = (float(i) + 0.5) / float(STEPS);
    float dt = 2.0 * d * u / float(STEPS);
    vec3 density = GetDensity(GetAltitudeAlongRay(h, mu, d * u * u));
    vec4 rayleigh = coefficients[0] * density.x;
    vec4 mie = coefficients[1] * density.y;
    vec4 extinction = coefficients * density;
    radiance += transmittance * (rayleigh + mie * aerosol_albedo)
        * IntegrateTransmittance(extinction, dt);
    transmittance *= exp(-extinction * dt);
  }
  return radiance + (ground ? ground_albedo * transmittance : vec4(0.0));
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy + tile_origin);
  ivec2 size = ivec2(pass_size) / ivec2(MOMENTS, 1);
  int moment = texel.x / size.x;
  ivec2 cell = ivec2(texel.x - moment * size.x, texel.y);
  float h = GetAltitudeOfField(float(cell.y) / float(size.y - 1));

  vec4 transfer_mean = vec4(0.0);
  vec4 transfer_moment = vec4(0.0);
  for (int j = 0; j < ZENITHS; ++j) {
    float mu = GetZenithCosine(j);
    vec4 transfer = 0.5 * WEIGHTS[j % 4] * GetTransfer(h, mu);
    // Even light is the same all round the zenith: <w_x^2> = (1 - mu^2) / 2, odd terms vanish.
    float weight = moment == 0 ? 1.0
        : moment == 2 ? mu
        : moment == 3 ? 0.5 * (1.0 - mu * mu) - 1.0 / 3.0
        : moment == 4 ? mu * mu - 1.0 / 3.0
        : 0.0;
    transfer_mean += transfer;
    transfer_moment += weight * transfer;
  }
  vec4 second_mean = GetMoment(second_order, SECOND_AZIMUTHS, 0, cell, size);
  vec4 second = GetMoment(second_order, SECOND_AZIMUTHS, moment, cell, size);
  vec4 first_mean = texelFetch(first_field, cell, 0);
  vec4 ratio = min(min(transfer_mean, vec4(0.999)), second_mean / max(first_mean, vec4(1e-30)));
  // What the series leaves out after its first n - 3 terms: nothing when it goes on for ever.
  vec4 omitted = scattering_orders == 0.0 ? vec4(0.0)
      : pow(max(ratio, 1e-9), vec4(max(scattering_orders - 3.0, 0.0)));
  vec4 rest = transfer_moment / max(transfer_mean, vec4(1e-30)) * second_mean * ratio
      * (1.0 - omitted) / (1.0 - ratio);
  float drawn = scattering_orders == 2.0 ? 0.0 : 1.0;
  result = texelFetch(first_field, texel, 0) + drawn * second + rest;
}
