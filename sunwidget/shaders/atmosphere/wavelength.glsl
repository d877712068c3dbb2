// The coefficients of atmosphere/atmosphere.glsl at any wavelength (nm), at density one, 1/m.

#include "atmosphere/atmosphere.glsl"
#include "atmosphere/spectrum.glsl"

Number GetRayleighScatteringAt(Number wavelength) {
  return air_density * GetBodhaineScattering(wavelength)
      * pow(wavelength / 550.0, kRayleighExponent - rayleigh_exponent);
}

Number GetMieExtinctionAt(Number wavelength) {
  return aerosol_optical_depth / aerosol_scale_height * pow(wavelength / 550.0, -angstrom_exponent);
}

Number GetOzoneAbsorptionAt(Number wavelength) {
  return ozone / (0.5 * (kOzoneTop - kOzoneBottom)) * GetOzoneDepthPerDobson(wavelength);
}
