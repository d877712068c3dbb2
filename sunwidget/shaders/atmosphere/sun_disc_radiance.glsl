// The sun's disc through the air, with its limb darkening.

#include "atmosphere/read_sky_view.glsl"

// Radiance of the disc, zero outside it. `size` is its diameter in units of the true 0.533
// degrees (the radiance does not change), `softness` the angle of one pixel. Each direction is
// reddened by its own path; the part below the horizon is dark.
RadianceSpectrum GetSunDiscRadiance(sampler2D columns, vec3 direction, vec3 sun, Length altitude,
                                    Number size, Angle softness) {
  float radius = kSunAngularRadius * size;
  // The chord is precise where acos(dot) is not.
  float angle = 2.0 * asin(min(0.5 * length(direction - sun), 1.0));
  float coverage = clamp((radius - angle) / max(softness, 1e-6) + 0.5, 0.0, 1.0);
  if (size <= 0.0 || coverage <= 0.0) {
    return vec4(0.0);
  }
  float x = min(angle / radius, 1.0);
  float mu = sqrt(max(1.0 - x * x, 1e-4));
  // mu^a averages 2 / (a + 2) over the disc, so this profile averages one.
  vec4 profile = pow(vec4(mu), kLimbDarkening) * (0.5 * kLimbDarkening + 1.0);
  vec4 radiance = kSolarIrradiance / (kPi * kSunAngularRadius * kSunAngularRadius);
  float above = direction.y - GetCosineOfHorizon(altitude);
  float risen = clamp(above / max(softness, 1e-6) + 0.5, 0.0, 1.0);
  return coverage * risen * profile * radiance
      * GetTransmittanceToTop(columns, altitude, direction.y);
}
