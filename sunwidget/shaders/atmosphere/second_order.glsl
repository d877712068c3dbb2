// Radiance of twice-scattered sunlight, laid out like first_order but with half the azimuths, because
// light is smooth after two scatterings.

#include "atmosphere/multiple.glsl"

uniform vec2 pass_size;
uniform vec2 tile_origin;
uniform sampler2D first_field;
out vec4 result;

const int kSteps = 12;

void main() {
  FieldRay ray = GetFieldRay(ivec2(gl_FragCoord.xy + tile_origin), ivec2(pass_size), kSecondAzimuths);
  mat3x4 coefficients = GetExtinctionCoefficients();
  vec3 mie_moments = GetMieMoments(aerosol_asymmetry);
  float lobe = GetLobe(mie_moments, ray.nu);
  float r = kGroundRadius + ray.h;
  vec4 transmittance = vec4(1.0);
  vec4 radiance = vec4(0.0);
  for (int i = 0; i < kSteps; ++i) {
    float u = (float(i) + 0.5) / float(kSteps);
    float t = ray.d * u * u;
    float dt = 2.0 * ray.d * u / float(kSteps);
    float h_t = GetAltitudeAlongRay(ray.h, ray.mu, t);
    float r_t = kGroundRadius + h_t;
    float mu_s_t = clamp((r * ray.mu_s + t * ray.nu) / r_t, -1.0, 1.0);
    vec2 view = GetDirectionInField(clamp((r * ray.mu + t) / r_t, -1.0, 1.0), mu_s_t, ray.nu);
    vec3 density = GetDensity(h_t);
    vec4 rayleigh = coefficients[0] * density.x;
    vec4 mie = coefficients[1] * density.y;
    vec4 extinction = coefficients * density;
    LightField field = GetLightField(first_field, h_t, mu_s_t);
    vec4 source = rayleigh * GetFieldThroughAir(field, view)
        + aerosol_albedo * mie * GetFieldThroughHaze(field, view, mie_moments, lobe);
    radiance += transmittance * source * IntegrateTransmittance(extinction, dt);
    transmittance *= exp(-extinction * dt);
  }
  if (ray.ground) {
    float mu_s_ground = clamp((r * ray.mu_s + ray.d * ray.nu) / kGroundRadius, -1.0, 1.0);
    radiance += transmittance * ground_albedo / kPi
        * GetFieldIrradiance(GetLightField(first_field, 0.0, mu_s_ground));
  }
  result = radiance;
}
