// Extinction of the air in three channels, and the photo's own haze.

uniform float source_air_density;
uniform float source_aerosol_optical_depth;
uniform float source_aerosol_scale_height;
uniform float source_angstrom_exponent;

// Rayleigh scattering at the ground at the wavelengths of Rec. 709's primaries (612, 549, 465 nm), 1/m
// (Bodhaine et al. 1999), and log2 of those wavelengths over 550 nm.
const vec3 kAirScattering = vec3(7.5e-6, 1.17e-5, 2.32e-5);
const vec3 kWavelengthSteps = vec3(0.154, -0.0026, -0.242);

// At the ground, 1/m per channel.
vec3 GetExtinction(float density, float optical_depth, float scale_height, float exponent) {
  return density * kAirScattering + optical_depth / scale_height * exp2(-exponent * kWavelengthSteps);
}
