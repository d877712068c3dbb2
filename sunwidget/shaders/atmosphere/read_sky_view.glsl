// Look-ups of the sky view.
//
// The sky view holds radiance divided by an approximation, the guess, so that the interpolated values
// are smooth even inside the aureole of a haze with g = 0.95. Its last row describes it (sun, haze,
// horizon), so a look-up needs only the texture: one function reads both the source's sky and the
// edited one.
//
// Directions are unit vectors in the camera's level frame: x right, y up, z heading.

#include "atmosphere/atmosphere.glsl"

const float kSkyShare = 0.85;  // of the rows, above the horizon

struct SkyView {
  vec3 sun;             // direction of the sun's center
  float asymmetry;      // Cornette-Shanks g
  vec4 rayleigh;        // weights of the guess
  vec4 mie;
  float horizon;        // elevation of the geometric horizon, radians, <= 0
};

vec3 GetSunDirection(float azimuth_degrees, float elevation_degrees) {
  float azimuth = radians(azimuth_degrees);
  float elevation = radians(elevation_degrees);
  return vec3(cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth));
}

// `origin` and `size` delimit the part of a texture that one view occupies.
SkyView ReadSkyView(sampler2D sky_view, ivec2 origin, ivec2 size) {
  ivec2 row = origin + ivec2(0, size.y - 1);
  vec4 first = texelFetch(sky_view, row, 0);
  return SkyView(first.xyz, first.w, texelFetch(sky_view, row + ivec2(1, 0), 0),
                 texelFetch(sky_view, row + ivec2(2, 0), 0),
                 texelFetch(sky_view, row + ivec2(3, 0), 0).x);
}

SkyView ReadSkyView(sampler2D sky_view) {
  return ReadSkyView(sky_view, ivec2(0), textureSize(sky_view, 0));
}

// The guess: single scattering by thin air and thin haze, plus a uniform share for all other orders.
vec4 GuessRadiance(SkyView view, Number nu) {
  return view.rayleigh * (RayleighPhase(nu) + 0.04) + view.mie * MiePhase(view.asymmetry, nu);
}

// Number of rows above the horizon and in total, without the description.
ivec2 GetSkyViewRows(int height) {
  return ivec2(int(float(height - 1) * kSkyShare), height - 1);
}

// Rows are denser near the horizon (square root), columns near the sun's azimuth.
Angle GetElevationOfRow(float row, ivec2 rows, Angle horizon) {
  if (row < float(rows.x)) {
    float v = 1.0 - row / float(rows.x - 1);
    return horizon + (0.5 * kPi - horizon) * v * v;
  }
  float v = (row - float(rows.x)) / float(rows.y - rows.x - 1);
  return horizon - (0.5 * kPi + horizon) * v * v;
}

float GetRowOfElevation(Angle elevation, ivec2 rows, Angle horizon) {
  if (elevation >= horizon) {
    float v = sqrt((elevation - horizon) / (0.5 * kPi - horizon));
    return (1.0 - min(v, 1.0)) * float(rows.x - 1);
  }
  float v = sqrt((horizon - elevation) / (0.5 * kPi + horizon));
  return float(rows.x) + min(v, 1.0) * float(rows.y - rows.x - 1);
}

// azimuth = pi (0.3 u + 0.7 u^2), relative to the sun's, 0..pi.
Angle GetAzimuthOfColumn(float u) {
  return kPi * u * (0.3 + 0.7 * u);
}

float GetColumnOfAzimuth(Angle azimuth) {
  return (sqrt(0.09 + 2.8 * azimuth / kPi) - 0.3) / 1.4;
}

RadianceSpectrum GetSkyRadiance(sampler2D sky_view, SkyView view, ivec2 origin, ivec2 size,
                                vec3 direction) {
  ivec2 rows = GetSkyViewRows(size.y);
  float elevation = asin(clamp(direction.y, -1.0, 1.0));
  float azimuth = abs(atan(view.sun.z * direction.x - view.sun.x * direction.z,
                           view.sun.x * direction.x + view.sun.z * direction.z));
  float row = GetRowOfElevation(elevation, rows, view.horizon);
  float column = clamp(GetColumnOfAzimuth(azimuth), 0.0, 1.0) * float(size.x - 1);
  // Never interpolate across the horizon.
  int first_row = row < float(rows.x) ? min(int(row), rows.x - 2)
                                      : clamp(int(row), rows.x, rows.y - 2);
  ivec2 corner = ivec2(min(int(column), size.x - 2), first_row);
  vec2 part = vec2(column, row) - vec2(corner);
  ivec2 texel = origin + corner;
  vec4 top = mix(texelFetch(sky_view, texel, 0),
                 texelFetch(sky_view, texel + ivec2(1, 0), 0), part.x);
  vec4 bottom = mix(texelFetch(sky_view, texel + ivec2(0, 1), 0),
                    texelFetch(sky_view, texel + ivec2(1, 1), 0), part.x);
  float nu = dot(direction, view.sun);
  return mix(top, bottom, part.y) * GuessRadiance(view, nu);
}

RadianceSpectrum GetSkyRadiance(sampler2D sky_view, vec3 direction) {
  return GetSkyRadiance(sky_view, ReadSkyView(sky_view), ivec2(0), textureSize(sky_view, 0), direction);
}

// Linear Rec. 709 in kcd m^-2; outside the gamut a channel is negative.
vec3 SpectralToRec709(RadianceSpectrum radiance) {
  return kSpectralToRec709 * radiance;
}
