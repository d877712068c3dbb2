// Phase functions over the scattering angle, one degree per texel (1/sr): molecules, aerosol, and
// their mixture at the camera at 550 nm.

#include "atmosphere/wavelength.glsl"

uniform float altitude;
out vec4 result;

void main() {
  float nu = cos(radians(floor(gl_FragCoord.x)));
  float rayleigh = RayleighPhase(nu);
  float mie = MiePhase(aerosol_asymmetry, nu);
  vec3 density = GetDensity(max(altitude, 1.0));
  float by_air = density.x * GetRayleighScatteringAt(550.0);
  float by_haze = density.y * GetMieExtinctionAt(550.0) * aerosol_albedo;
  float mixture = (by_air * rayleigh + by_haze * mie) / max(by_air + by_haze, 1e-30);
  result = vec4(rayleigh, mie, mixture, 0.0);
}
