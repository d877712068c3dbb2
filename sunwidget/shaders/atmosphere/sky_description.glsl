// The sun and camera of a sky view, and its description in the last row (atmosphere/read_sky_view.glsl).

#include "atmosphere/read_sky_view.glsl"

uniform float sun_azimuth;    // degrees from the camera's heading, + right
uniform float sun_elevation;  // degrees, apparent
uniform float altitude;       // m

Length GetCameraHeight() {
  // One meter keeps the horizon below the eye; otherwise grazing rays would start in the ground.
  return clamp(altitude, 1.0, 0.99 * kAtmosphereHeight);
}

SkyView DescribeSky() {
  float h = GetCameraHeight();
  vec3 density = GetDensity(h);
  // Optical depths overhead, never zero, so that division by the guess is safe without air or haze.
  vec4 rayleigh = GetRayleighScattering() * rayleigh_scale_height * density.x + 1e-4;
  vec4 mie = GetMieExtinction() * aerosol_albedo * aerosol_scale_height * density.y;
  return SkyView(GetSunDirection(sun_azimuth, sun_elevation), aerosol_asymmetry, rayleigh, mie,
                 asin(GetCosineOfHorizon(h)));
}

vec4 GetDescriptionTexel(SkyView view, int column) {
  return column == 0 ? vec4(view.sun, view.asymmetry)
      : column == 1 ? view.rayleigh
      : column == 2 ? view.mie
      : vec4(view.horizon);
}
