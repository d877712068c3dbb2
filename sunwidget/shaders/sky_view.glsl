// Radiance of the sky around the camera, without the sun's disc: azimuth from the sun along x
// (half the circle; the other half mirrors it), elevation along y, zenith in row 0, everything
// divided by GuessRadiance. See lib/sky.glsl for the layout and the description in the last row.
// Below the horizon: the ground under air light.

#include "lib/sky.glsl"
#include "lib/multiple.glsl"

uniform float sun_azimuth;    // degrees from the camera's heading, + right
uniform float sun_elevation;  // degrees, apparent
uniform float altitude;       // m
uniform float scattering_orders;  // 0 all, 1 single scattering
uniform vec2 pass_size;
uniform vec2 tile_origin;
uniform sampler2D columns;
uniform sampler2D multiple_scattering;
out vec4 result;

// The light field is smooth: one look-up serves a group of steps.
const int GROUPS = 16;
const int GROUP_STEPS = 2;

Length GetCameraHeight() {
  // One metre keeps the horizon below the eye; grazing rays would else start in the ground.
  return clamp(altitude, 1.0, 0.99 * ATMOSPHERE_HEIGHT);
}

SkyView DescribeSky() {
  float h = GetCameraHeight();
  vec3 density = GetDensity(h);
  // Optical depths overhead, never zero, so that the division is safe without air or haze.
  vec4 rayleigh = GetRayleighScattering() * rayleigh_scale_height * density.x + 1e-4;
  vec4 mie = GetMieExtinction() * aerosol_albedo * aerosol_scale_height * density.y;
  return SkyView(GetSunDirection(sun_azimuth, sun_elevation), aerosol_asymmetry, rayleigh, mie,
                 asin(GetCosineOfHorizon(h)));
}

// Single scattering alone leaves out what lib/multiple.glsl knows, whichever orders that holds.
Number GetFieldShare() {
  return scattering_orders == 1.0 ? 0.0 : 1.0;
}

// What a Lambertian ground sends up at the point where the sun has cosine mu_s.
RadianceSpectrum GetGroundRadiance(Number mu_s) {
  vec4 sun = max(mu_s, 0.0) * GetTransmittanceToSun(columns, 0.0, mu_s);
  LightField field = GetLightField(multiple_scattering, 0.0, mu_s);
  return ground_albedo / PI * (sun + GetFieldShare() * GetFieldIrradiance(field));
}

RadianceSpectrum ComputeSkyRadiance(Length h, Number mu, Number mu_s, Number nu) {
  float r = GROUND_RADIUS + h;
  bool ground = RayIntersectsGround(h, mu);
  float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
  mat3x4 coefficients = GetExtinctionCoefficients();
  float rayleigh_phase = RayleighPhase(nu);
  float mie_phase = MiePhase(aerosol_asymmetry, nu);

  vec3 mie_moments = GetMieMoments(aerosol_asymmetry);
  float lobe = GetLobe(mie_moments, nu);
  vec4 transmittance = vec4(1.0);
  vec4 radiance = vec4(0.0);
  for (int group = 0; group < GROUPS; ++group) {
    float u_group = (float(group) + 0.5) / float(GROUPS);
    float t_group = d * u_group * u_group;
    float h_group = GetAltitudeAlongRay(h, mu, t_group);
    float r_group = GROUND_RADIUS + h_group;
    float mu_s_group = clamp((r * mu_s + t_group * nu) / r_group, -1.0, 1.0);
    float mu_group = clamp((r * mu + t_group) / r_group, -1.0, 1.0);
    LightField field = GetLightField(multiple_scattering, h_group, mu_s_group);
    vec2 view = GetDirectionInField(mu_group, mu_s_group, nu);
    vec4 through_air = GetFieldShare() * GetFieldThroughAir(field, view);
    vec4 through_haze = GetFieldShare() * GetFieldThroughHaze(field, view, mie_moments, lobe);
    for (int i = 0; i < GROUP_STEPS; ++i) {
      float steps = float(GROUPS * GROUP_STEPS);
      float u = (float(group * GROUP_STEPS + i) + 0.5) / steps;
      float t = d * u * u;
      float dt = 2.0 * d * u / steps;
      float h_t = GetAltitudeAlongRay(h, mu, t);
      float mu_s_t = clamp((r * mu_s + t * nu) / (GROUND_RADIUS + h_t), -1.0, 1.0);
      vec3 density = GetDensity(h_t);
      vec4 rayleigh = coefficients[0] * density.x;
      vec4 mie = coefficients[1] * density.y;
      vec4 extinction = coefficients * density;
      mie *= aerosol_albedo;
      vec4 sun = GetTransmittanceToSun(columns, h_t, mu_s_t);
      vec4 source = rayleigh * (sun * rayleigh_phase + through_air)
          + mie * (sun * mie_phase + through_haze);
      radiance += transmittance * source * IntegrateTransmittance(extinction, dt);
      transmittance *= exp(-extinction * dt);
    }
  }
  if (ground) {
    float mu_s_ground = clamp((r * mu_s + d * nu) / GROUND_RADIUS, -1.0, 1.0);
    radiance += transmittance * GetGroundRadiance(mu_s_ground);
  }
  return SOLAR_IRRADIANCE * radiance;
}

void main() {
  vec2 texel = gl_FragCoord.xy + tile_origin - 0.5;
  SkyView view = DescribeSky();
  ivec2 rows = GetSkyViewRows(int(pass_size.y));
  int row = int(texel.y + 0.5);
  int column = int(texel.x + 0.5);
  if (row == rows.y) {
    result = column == 0 ? vec4(view.sun, view.asymmetry)
        : column == 1 ? view.rayleigh
        : column == 2 ? view.mie
        : vec4(view.horizon);
    return;
  }
  float h = GetCameraHeight();
  float elevation = GetElevationOfRow(float(row), rows, view.horizon);
  float azimuth = GetAzimuthOfColumn(float(column) / (pass_size.x - 1.0));
  float mu = sin(elevation);
  if (row == rows.x - 1) {
    mu = GetCosineOfHorizon(h);  // exactly grazing, from above
  } else if (row == rows.x) {
    mu = GetCosineOfHorizon(h) - 1e-6;  // and from below
  }
  float mu_s = view.sun.y;
  float nu = mu * mu_s + cos(elevation) * sqrt(max(1.0 - mu_s * mu_s, 0.0)) * cos(azimuth);
  result = ComputeSkyRadiance(h, mu, mu_s, nu) / GuessRadiance(view, nu);
}
