// The clear atmosphere: geometry of a spherical shell, densities, phase functions and
// transmittance. Structure after Hillaire, "A Scalable and Production Ready Sky and Atmosphere
// Rendering Technique" (2020); names after Bruneton, "Precomputed Atmospheric Scattering" (2017):
//   h     altitude above the ground, m          mu    cosine of a ray's zenith angle
//   d, t  distances along a ray, m              mu_s  cosine of the sun's zenith angle
//   nu    cosine of the angle between ray and sun
// Spectra are vec4: 640, 580, 510, 440 nm.

#include "atmosphere/constants.glsl"

uniform float air_density;            // molecules at sea level relative to standard air, 0..2
uniform float rayleigh_exponent;      // 4.09 in real air
uniform float rayleigh_scale_height;  // m
uniform float aerosol_scale_height;   // m
uniform float aerosol_optical_depth;  // at 550 nm, vertical, 0..0.6
uniform float angstrom_exponent;      // 0..2
uniform float aerosol_asymmetry;      // Cornette-Shanks g, 0..0.95
uniform float aerosol_albedo;         // single-scattering albedo, 0.7..1
uniform float ozone;                  // Dobson units, 0..500
uniform float ground_albedo;          // Lambertian, 0..1

// ---- Geometry -------------------------------------------------------------------------------
// With q = r^2 - R^2 the altitude is q / (sqrt(R^2 + q) + R). This avoids a difference of large radii,
// so single precision resolves centimeters at 6360 km.

Number GetSquaredHorizonDistance(Length h) {
  return h * (2.0 * kGroundRadius + h);
}

Length GetAltitudeAlongRay(Length h, Number mu, Length t) {
  float q = GetSquaredHorizonDistance(h) + t * (2.0 * (kGroundRadius + h) * mu + t);
  return max(q, 0.0) / (sqrt(kGroundRadius * kGroundRadius + max(q, 0.0)) + kGroundRadius);
}

Length GetDistanceToTop(Length h, Number mu) {
  float r_mu = (kGroundRadius + h) * mu;
  float shell = (kAtmosphereHeight - h) * (kTopRadius + kGroundRadius + h);
  float root = sqrt(r_mu * r_mu + shell);
  // Choose the one of two equal forms that does not cancel.
  return r_mu > 0.0 ? shell / (root + r_mu) : root - r_mu;
}

Number GetCosineOfHorizon(Length h) {
  return -sqrt(GetSquaredHorizonDistance(h)) / (kGroundRadius + h);
}

bool RayIntersectsGround(Length h, Number mu) {
  return mu < GetCosineOfHorizon(h);
}

Length GetDistanceToGround(Length h, Number mu) {
  float r_mu = -(kGroundRadius + h) * mu;
  float q = GetSquaredHorizonDistance(h);
  return q / (r_mu + sqrt(max(r_mu * r_mu - q, 0.0)));
}

// Share of the sun's disc above the horizon for a sun whose center is `above` it (radians).
Number GetVisibleFractionOfDisc(Angle above) {
  float x = clamp(above / kSunAngularRadius, -1.0, 1.0);
  return 0.5 + (x * sqrt(1.0 - x * x) + asin(x)) / kPi;
}

// ---- Constituents of the air ----------------------------------------------------------------

// Relative density of Rayleigh scatterers, aerosol and ozone at altitude h.
vec3 GetDensity(Length h) {
  float below = (h - kOzoneBottom) / (kOzonePeak - kOzoneBottom);
  float above = (kOzoneTop - h) / (kOzoneTop - kOzonePeak);
  // Above kMesosphereAltitude air thins faster: its scale height keeps its ratio to the one below.
  float thin = kRayleighScaleHeight / kMesosphereScaleHeight - 1.0;
  float air = (h + max(h - kMesosphereAltitude, 0.0) * thin) / rayleigh_scale_height;
  return vec3(exp(-air), exp(-h / aerosol_scale_height), max(0.0, min(below, above)));
}

// Bodhaine's coefficients, tilted if another exponent is set.
ScatteringSpectrum GetRayleighScattering() {
  return air_density * kRayleighScattering
      * pow(kWavelengths / 550.0, vec4(kRayleighExponent - rayleigh_exponent));
}

ScatteringSpectrum GetMieExtinction() {
  return aerosol_optical_depth / aerosol_scale_height
      * pow(kWavelengths / 550.0, vec4(-angstrom_exponent));
}

ScatteringSpectrum GetOzoneAbsorption() {
  // The tent's integral is half its width.
  return ozone / (0.5 * (kOzoneTop - kOzoneBottom)) * kOzoneDepthPerDobson;
}

// Extinction of the three constituents at density one, 1/m. Times densities it gives the extinction
// coefficient, times columns the optical depth.
mat3x4 GetExtinctionCoefficients() {
  return mat3x4(GetRayleighScattering(), GetMieExtinction(), GetOzoneAbsorption());
}

// ---- Phase functions (integrate to one over the sphere) -------------------------------------

Number RayleighPhase(Number nu) {
  return 3.0 / (16.0 * kPi) * (1.0 + nu * nu);
}

// Cornette & Shanks 1992, eq. 8.
Number MiePhase(Number g, Number nu) {
  float base = max(1.0 + g * g - 2.0 * g * nu, 1e-6);
  return 3.0 / (8.0 * kPi) * (1.0 - g * g) * (1.0 + nu * nu)
      / ((2.0 + g * g) * base * sqrt(base));
}

// ---- Columns and transmittance --------------------------------------------------------------
// The table holds path lengths to the top, not transmittances: so it depends only on the scale heights,
// and exp() after the interpolation errs 0.6 % at the horizon instead of 13 %.
// Coordinates after Bruneton 2017: x from the distance to the top, y from the distance to the
// horizon, here on a square-root scale (h is about y^4) because haze lies low.

const float kLongestHorizon = 1132254.3;  // sqrt(kTopRadius^2 - kGroundRadius^2), m

vec2 GetColumnsCoordinate(Length h, Number mu) {
  float rho = sqrt(GetSquaredHorizonDistance(h));
  float d_min = kAtmosphereHeight - h;
  float d_max = rho + kLongestHorizon;
  return vec2((GetDistanceToTop(h, mu) - d_min) / (d_max - d_min),
              sqrt(rho / kLongestHorizon));
}

// Texel centers lie on the ends of [0, 1], so that the horizon is sampled, not extrapolated.
vec4 FetchBilinear(sampler2D table, vec2 coordinate) {
  ivec2 last = textureSize(table, 0) - 1;
  vec2 place = clamp(coordinate, 0.0, 1.0) * vec2(last);
  ivec2 corner = min(ivec2(place), last - 1);
  vec2 part = place - vec2(corner);
  vec4 upper = mix(texelFetch(table, corner, 0), texelFetch(table, corner + ivec2(1, 0), 0), part.x);
  vec4 lower = mix(texelFetch(table, corner + ivec2(0, 1), 0),
                 texelFetch(table, corner + ivec2(1, 1), 0), part.x);
  return mix(upper, lower, part.y);
}

DimensionlessSpectrum GetTransmittanceOfColumns(vec3 path) {
  return exp(-(GetExtinctionCoefficients() * path));
}

// Transmittance to the top of the atmosphere; rays below the horizon count as grazing it.
DimensionlessSpectrum GetTransmittanceToTop(sampler2D columns, Length h, Number mu) {
  float grazing = max(mu, GetCosineOfHorizon(h));
  return GetTransmittanceOfColumns(FetchBilinear(columns, GetColumnsCoordinate(h, grazing)).xyz);
}

// Transmittance to the sun times the visible share of its disc. The smooth step approximates
// GetVisibleFractionOfDisc (within 0.02), because it is evaluated at every step of a march.
DimensionlessSpectrum GetTransmittanceToSun(sampler2D columns, Length h, Number mu_s) {
  float above = mu_s - GetCosineOfHorizon(h);
  return GetTransmittanceToTop(columns, h, mu_s)
      * smoothstep(-kSunAngularRadius, kSunAngularRadius, above);
}

// ---- Integration along a ray ----------------------------------------------------------------

// Integral of exp(-extinction t) over t from 0 to dt, as a series where 1 - exp() would cancel.
vec4 IntegrateTransmittance(vec4 extinction, Length dt) {
  vec4 x = extinction * dt;
  vec4 series = dt * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0)));
  vec4 closed = (1.0 - exp(-x)) / max(extinction, vec4(1e-30));
  return mix(closed, series, lessThan(x, vec4(0.05)));
}
