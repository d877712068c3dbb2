// The sky's radiance along one ray: single scattering is marched, all higher orders come from the
// table of scattered light, and rays below the horizon end on the ground.

#include "atmosphere/multiple.glsl"

uniform float scattering_orders;  // 0 all, 1 single scattering
uniform sampler2D columns;
uniform sampler2D multiple_scattering;

// The light field is smooth: one look-up serves a group of steps.
const int kGroups = 16;
const int kGroupSteps = 2;

// Single scattering alone ignores the field of atmosphere/multiple.glsl, whichever orders that holds.
Number GetFieldShare() {
  return scattering_orders == 1.0 ? 0.0 : 1.0;
}

// Radiance of a Lambertian ground at the point where the sun's zenith angle has cosine mu_s.
RadianceSpectrum GetGroundRadiance(Number mu_s) {
  vec4 sun = max(mu_s, 0.0) * GetTransmittanceToSun(columns, 0.0, mu_s);
  LightField field = GetLightField(multiple_scattering, 0.0, mu_s);
  return ground_albedo / kPi * (sun + GetFieldShare() * GetFieldIrradiance(field));
}

RadianceSpectrum ComputeSkyRadiance(Length h, Number mu, Number mu_s, Number nu) {
  float r = kGroundRadius + h;
  bool ground = RayIntersectsGround(h, mu);
  float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
  mat3x4 coefficients = GetExtinctionCoefficients();
  float rayleigh_phase = RayleighPhase(nu);
  float mie_phase = MiePhase(aerosol_asymmetry, nu);

  vec3 mie_moments = GetMieMoments(aerosol_asymmetry);
  float lobe = GetLobe(mie_moments, nu);
  vec4 transmittance = vec4(1.0);
  vec4 radiance = vec4(0.0);
  for (int group = 0; group < kGroups; ++group) {
    float u_group = (float(group) + 0.5) / float(kGroups);
    float t_group = d * u_group * u_group;
    float h_group = GetAltitudeAlongRay(h, mu, t_group);
    float r_group = kGroundRadius + h_group;
    float mu_s_group = clamp((r * mu_s + t_group * nu) / r_group, -1.0, 1.0);
    float mu_group = clamp((r * mu + t_group) / r_group, -1.0, 1.0);
    LightField field = GetLightField(multiple_scattering, h_group, mu_s_group);
    vec2 view = GetDirectionInField(mu_group, mu_s_group, nu);
    vec4 through_air = GetFieldShare() * GetFieldThroughAir(field, view);
    vec4 through_haze = GetFieldShare() * GetFieldThroughHaze(field, view, mie_moments, lobe);
    for (int i = 0; i < kGroupSteps; ++i) {
      float steps = float(kGroups * kGroupSteps);
      float u = (float(group * kGroupSteps + i) + 0.5) / steps;
      float t = d * u * u;
      float dt = 2.0 * d * u / steps;
      float h_t = GetAltitudeAlongRay(h, mu, t);
      float mu_s_t = clamp((r * mu_s + t * nu) / (kGroundRadius + h_t), -1.0, 1.0);
      vec3 density = GetDensity(h_t);
      vec4 rayleigh = coefficients[0] * density.x;
      vec4 mie = coefficients[1] * density.y;
      vec4 extinction = coefficients * density;
      mie *= aerosol_albedo;
      vec4 sun = GetTransmittanceToSun(columns, h_t, mu_s_t);
      vec4 source = rayleigh * (sun * rayleigh_phase + through_air)
          + mie * (sun * mie_phase + through_haze);
      radiance += transmittance * source * IntegrateTransmittance(extinction, dt);
      transmittance *= exp(-(extinction * dt));
    }
  }
  if (ground) {
    float mu_s_ground = clamp((r * mu_s + d * nu) / kGroundRadius, -1.0, 1.0);
    radiance += transmittance * GetGroundRadiance(mu_s_ground);
  }
  return kSolarIrradiance * radiance;
}
